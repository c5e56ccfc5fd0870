/* What the C library answers: answers CONFIGURATION REQUESTS CYCLES ANSWERS SHOWN.
 *
 * All but the configuration are files of 64-bit integers, one line of a table after the other.
 */
#include <stdio.h>
#include <stdlib.h>

#include "blysk.h"

static void need(int good, const char *what)
{
    if (!good) {
        fprintf(stderr, "answers: %s: %s\n", what, blysk_last_error());
        exit(2);
    }
}

/* The integers of a file, and how many lines of so many there are. */
static int64_t *integers(const char *path, size_t columns, size_t *lines)
{
    FILE *file = fopen(path, "rb");
    need(file != NULL && fseek(file, 0, SEEK_END) == 0, path);
    long bytes = ftell(file);
    rewind(file);
    int64_t *read = malloc((size_t)bytes);
    need(read != NULL && fread(read, 1, (size_t)bytes, file) == (size_t)bytes, path);
    fclose(file);
    *lines = (size_t)bytes / (columns * sizeof *read);
    return read;
}

static void write_line(FILE *file, const int64_t *line, size_t columns)
{
    need(fwrite(line, sizeof *line, columns, file) == columns, "write");
}

int main(int count, char **words)
{
    need(count == 6, "five files");
    blysk_model *model;
    need(blysk_model_from_file(BLYSK_ABI_VERSION, words[1], &model) == BLYSK_CODE_OK, "model");

    size_t lines;
    int64_t *requests = integers(words[2], 2, &lines);
    uint32_t *addresses = malloc(lines * sizeof *addresses);
    int64_t *x = malloc(lines * sizeof *x), *bits = malloc(lines * sizeof *bits);
    uint8_t *status = malloc(lines);
    for (size_t i = 0; i < lines; i++) {
        addresses[i] = (uint32_t)requests[2 * i];
        x[i] = requests[2 * i + 1];
    }
    need(blysk_evaluate(model, addresses, lines, x, lines, bits, status) == BLYSK_CODE_OK, "evaluate");
    FILE *answers = fopen(words[4], "wb");
    need(answers != NULL, words[4]);
    for (size_t i = 0; i < lines; i++)
        write_line(answers, (int64_t[]){bits[i], status[i]}, 2);
    need(fclose(answers) == 0, words[4]);

    int64_t *cycles = integers(words[3], 5, &lines);
    blysk_pipeline *pipeline;
    need(blysk_pipeline_new(model, &pipeline) == BLYSK_CODE_OK, "pipeline");
    FILE *shown = fopen(words[5], "wb");
    need(shown != NULL, words[5]);
    for (size_t i = 0; i < lines; i++) {
        const int64_t *cycle = cycles + 5 * i;
        blysk_inputs inputs = {.reset = cycle[0] != 0, .in_valid = cycle[1] != 0, .address = (uint32_t)cycle[2],
                               .x = cycle[3], .out_ready = cycle[4] != 0};
        blysk_outputs outputs;
        need(blysk_pipeline_tick(pipeline, &inputs, &outputs) == BLYSK_CODE_OK, "tick");
        write_line(shown, (int64_t[]){outputs.in_ready, outputs.out_valid, outputs.intensity, outputs.status}, 4);
    }
    need(fclose(shown) == 0, words[5]);

    blysk_pipeline_free(pipeline);
    blysk_model_free(model);
    free(requests), free(addresses), free(x), free(bits), free(status), free(cycles);
    return 0;
}
