/* One highlight, an array of them, every register on the way, and the clocked pipeline.
 *
 *   cc -std=c11 highlight.c $(pkg-config --cflags --libs blysk) && ./a.out
 */
#include <stdio.h>
#include <stdlib.h>

#include "blysk.h"

/* Ends the program with the library's own sentence. */
static void need(blysk_code code)
{
    if (code != BLYSK_CODE_OK) {
        fprintf(stderr, "highlight: %s\n", blysk_last_error());
        exit(2);
    }
}

int main(void)
{
    blysk_model *model;
    need(blysk_model_preset(BLYSK_ABI_VERSION, "compact", &model));
    blysk_interface ports;
    need(blysk_model_interface(model, &ports));

    /* In real numbers. */
    double intensity;
    need(blysk_highlight(model, 64.0, 0.99, &intensity));
    printf("0.99^64 is about %.6f\n", intensity);

    /* Bit for bit, many at a time: one address for all of them. */
    enum { COUNT = 5 };
    uint32_t address;
    int64_t x[COUNT], bits[COUNT];
    uint8_t status[COUNT];
    need(blysk_address(model, 64.0, &address));
    for (int i = 0; i < COUNT; i++)
        need(blysk_x_bits(model, 0.96 + 0.01 * i, &x[i]));
    need(blysk_evaluate(model, &address, 1, x, COUNT, bits, status));
    for (int i = 0; i < COUNT; i++)
        printf("x %lld: intensity %lld, status %u\n", (long long)x[i], (long long)bits[i], status[i]);

    /* Every register of every rank. */
    blysk_register *registers = calloc(ports.register_count, sizeof *registers);
    if (registers == NULL)
        return 2;
    need(blysk_registers(model, address, x[3], registers, ports.register_count));
    for (size_t i = 0; i < ports.register_count; i++)
        printf("rank %u  %-20s %12lld  %.9g\n", registers[i].rank, registers[i].name, (long long)registers[i].bits,
               registers[i].value);
    free(registers);

    /* A clock edge at a time: the result comes out after as many cycles as there are ranks. */
    blysk_pipeline *pipeline;
    need(blysk_pipeline_new(model, &pipeline));
    blysk_inputs inputs = {.in_valid = true, .out_ready = true, .address = address, .x = x[3]};
    blysk_outputs outputs;
    unsigned cycle = 0;
    for (;; cycle++) {
        need(blysk_pipeline_tick(pipeline, &inputs, &outputs));
        inputs.in_valid = false;
        if (outputs.out_valid)
            break;
    }
    printf("cycle %u: intensity %lld, and the latency is %u\n", cycle, (long long)outputs.intensity, ports.latency);

    blysk_pipeline_free(pipeline);
    blysk_model_free(model);
    return outputs.intensity == bits[3] && cycle == ports.latency ? 0 : 1;
}
