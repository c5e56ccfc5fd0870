/* Nanoseconds of a sample of arrays and of a clocked cycle through the C ABI; benches/checker.rs runs it. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "blysk.h"

enum { SAMPLES = 1 << 16, REPEATS = 100, CYCLES = 1000000 };

/* Seconds of the processor that this program has had. */
static double now(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static void need(blysk_code code)
{
    if (code != BLYSK_CODE_OK) {
        fprintf(stderr, "bench: %s\n", blysk_last_error());
        exit(2);
    }
}

int main(void)
{
    static int64_t x[SAMPLES], intensity[SAMPLES];
    static uint8_t status[SAMPLES];
    const uint32_t address = 63;
    blysk_model *model;
    need(blysk_model_preset(BLYSK_ABI_VERSION, "compact", &model));
    for (int64_t i = 0; i < SAMPLES; i++)
        x[i] = i * 127 % (1 << 23);
    double start = now();
    for (int repeat = 0; repeat < REPEATS; repeat++)
        need(blysk_evaluate(model, &address, 1, x, SAMPLES, intensity, status));
    double arrays = now() - start;

    blysk_pipeline *pipeline;
    need(blysk_pipeline_new(model, &pipeline));
    start = now();
    for (uint32_t cycle = 0; cycle < CYCLES; cycle++) {
        blysk_inputs inputs = {.in_valid = true, .out_ready = true, .address = cycle % 256,
                               .x = (int64_t)cycle * 127 % (1 << 23)};
        blysk_outputs outputs;
        need(blysk_pipeline_tick(pipeline, &inputs, &outputs));
    }
    double cycles = now() - start;
    printf("%.3f ns %.3f ns\n", arrays * 1e9 / ((double)SAMPLES * REPEATS), cycles * 1e9 / CYCLES);
    blysk_pipeline_free(pipeline);
    blysk_model_free(model);
    return 0;
}
