/* Two threads ask one model at the same time, each with a pipeline of its own; both must find what the other finds.
 *
 *   cc -std=c11 threads.c $(pkg-config --cflags --libs blysk) -lpthread && ./a.out
 */
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "blysk.h"

enum { COUNT = 20000 };

struct work {
    const blysk_model *model;
    int64_t intensity[COUNT];
    uint64_t clocked; /* the sum of the intensities that the pipeline gave */
    bool refused;     /* whether this thread's own error was this thread's own sentence */
};

static void *run(void *argument)
{
    struct work *work = argument;
    static const char sentence[] = "there is no preset";
    blysk_model *none;
    work->refused = blysk_model_preset(BLYSK_ABI_VERSION, "none", &none) == BLYSK_CODE_NO_PRESET && none == NULL &&
                    strstr(blysk_last_error(), sentence) != NULL;

    static _Thread_local int64_t x[COUNT];
    static _Thread_local uint32_t addresses[COUNT];
    static _Thread_local uint8_t status[COUNT];
    blysk_interface ports;
    if (blysk_model_interface(work->model, &ports) != BLYSK_CODE_OK)
        return NULL;
    for (int i = 0; i < COUNT; i++) {
        x[i] = (int64_t)(i * 419) % ((int64_t)1 << ports.x.fraction_bits);
        addresses[i] = (uint32_t)i % ports.depth;
    }
    if (blysk_evaluate(work->model, addresses, COUNT, x, COUNT, work->intensity, status) != BLYSK_CODE_OK)
        return NULL;

    blysk_pipeline *pipeline;
    if (blysk_pipeline_new(work->model, &pipeline) != BLYSK_CODE_OK)
        return NULL;
    for (int i = 0; i < COUNT; i++) {
        blysk_inputs inputs = {.in_valid = true, .out_ready = i % 3 != 0, .address = addresses[i], .x = x[i]};
        blysk_outputs outputs;
        if (blysk_pipeline_tick(pipeline, &inputs, &outputs) == BLYSK_CODE_OK && outputs.out_valid)
            work->clocked += (uint64_t)outputs.intensity;
    }
    blysk_pipeline_free(pipeline);
    return NULL;
}

int main(void)
{
    blysk_model *model;
    if (blysk_model_preset(BLYSK_ABI_VERSION, "paper", &model) != BLYSK_CODE_OK) {
        fprintf(stderr, "threads: %s\n", blysk_last_error());
        return 2;
    }
    static struct work work[2];
    pthread_t threads[2];
    for (int i = 0; i < 2; i++) {
        work[i].model = model;
        if (pthread_create(&threads[i], NULL, run, &work[i]) != 0)
            return 2;
    }
    for (int i = 0; i < 2; i++)
        pthread_join(threads[i], NULL);
    blysk_model_free(model);
    bool same = memcmp(work[0].intensity, work[1].intensity, sizeof work[0].intensity) == 0 && work[0].clocked != 0 &&
                work[0].clocked == work[1].clocked && work[0].refused && work[1].refused;
    printf("%s: %d samples and cycles in each of two threads\n", same ? "the same" : "DIFFERENT", COUNT);
    return same ? 0 : 1;
}
