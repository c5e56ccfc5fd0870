/* Every function of blysk.h: what it gives, and what it refuses. Prints the number of checks; none that fails is
 * passed over. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "blysk.h"

static unsigned checks, failures;

#define CHECK(condition)                                                                                               \
    do {                                                                                                               \
        checks++;                                                                                                      \
        if (!(condition)) {                                                                                            \
            failures++;                                                                                                \
            printf("%s:%d: %s; the last error: %s\n", __FILE__, __LINE__, #condition, blysk_last_error());             \
        }                                                                                                              \
    } while (0)

/* The call is refused with this code, and the sentence has these words in it. */
#define REFUSED(call, wanted, words)                                                                                   \
    do {                                                                                                               \
        CHECK((call) == (wanted));                                                                                     \
        CHECK(strstr(blysk_last_error(), words) != NULL);                                                              \
    } while (0)

#define OK(call) CHECK((call) == BLYSK_CODE_OK)

static void versions(void)
{
    CHECK(blysk_abi_version() == BLYSK_ABI_VERSION);
    CHECK(strlen(blysk_version()) >= 5);
    blysk_model *model = (blysk_model *)&checks;
    REFUSED(blysk_model_preset(BLYSK_ABI_VERSION + 1, "compact", &model), BLYSK_CODE_ABI, "header");
    CHECK(model == NULL);
}

static void constructors(void)
{
    blysk_model *model;
    CHECK(strlen(blysk_last_error()) > 0);
    REFUSED(blysk_model_preset(BLYSK_ABI_VERSION, "none", &model), BLYSK_CODE_NO_PRESET, "compact");
    CHECK(model == NULL);
    REFUSED(blysk_model_preset(BLYSK_ABI_VERSION, NULL, &model), BLYSK_CODE_NULL, "null");
    REFUSED(blysk_model_preset(BLYSK_ABI_VERSION, "compact", NULL), BLYSK_CODE_NULL, "null");
    REFUSED(blysk_model_preset(BLYSK_ABI_VERSION, "\xff", &model), BLYSK_CODE_TEXT, "UTF-8");
    REFUSED(blysk_model_from_json(BLYSK_ABI_VERSION, "{", &model), BLYSK_CODE_CONFIGURATION, "EOF");
    REFUSED(blysk_model_from_json(BLYSK_ABI_VERSION, NULL, &model), BLYSK_CODE_NULL, "null");
    REFUSED(blysk_model_from_file(BLYSK_ABI_VERSION, "/none/none.json", &model), BLYSK_CODE_CONFIGURATION, "none.json");
    REFUSED(blysk_model_from_file(BLYSK_ABI_VERSION, NULL, &model), BLYSK_CODE_NULL, "null");
    blysk_model_free(NULL);
    blysk_pipeline_free(NULL);
    blysk_scoreboard_free(NULL);

    static const char small[] =
        "{\"name\": \"small\", \"method\": \"hermite\", \"exponents\": \"1..=8\", \"input\": \"Q2.9\","
        "\"output\": \"UQ1.8\", \"form\": \"power\", \"tail\": \"rational\", \"quotient_bits_per_stage\": 3}";
    OK(blysk_model_from_json(BLYSK_ABI_VERSION, small, &model));
    blysk_interface ports;
    OK(blysk_model_interface(model, &ports));
    CHECK(ports.x.is_signed && ports.x.width == 11 && ports.x.integer_bits == 2 && ports.x.fraction_bits == 9);
    CHECK(ports.depth == 8 && ports.address.width == 4);
    /* x = -1/2 faces away. */
    uint32_t address = 0;
    int64_t x = -256, intensity = 1;
    uint8_t status = 0;
    OK(blysk_evaluate(model, &address, 1, &x, 1, &intensity, &status));
    CHECK(intensity == 0 && status == BLYSK_STATUS_FACING_AWAY);
    blysk_model_free(model);
}

static void real_numbers(const blysk_model *model)
{
    double intensity = 2.0;
    OK(blysk_highlight(model, 64.0, 0.99, &intensity));
    CHECK(fabs(intensity - pow(0.99, 64.0)) < 0.0067);
    OK(blysk_highlight(model, 64.0, -0.5, &intensity));
    CHECK(intensity == 0.0);
    REFUSED(blysk_highlight(model, 64.5, 0.99, &intensity), BLYSK_CODE_EXPONENT, "64.5");
    REFUSED(blysk_highlight(model, 64.0, NAN, &intensity), BLYSK_CODE_X, "NaN");
    REFUSED(blysk_highlight(NULL, 64.0, 0.5, &intensity), BLYSK_CODE_NULL, "the model");
    REFUSED(blysk_highlight(model, 64.0, 0.5, NULL), BLYSK_CODE_NULL, "null");
    uint32_t address = 7;
    OK(blysk_address(model, 64.0, &address));
    CHECK(address == 63);
    REFUSED(blysk_address(model, 0.5, &address), BLYSK_CODE_EXPONENT, "0.5");
    REFUSED(blysk_address(model, 1.0, NULL), BLYSK_CODE_NULL, "null");
    REFUSED(blysk_address(NULL, 1.0, &address), BLYSK_CODE_NULL, "the model");
    int64_t bits = 0;
    OK(blysk_x_bits(model, 0.5, &bits));
    CHECK(bits == 1 << 22);
    OK(blysk_x_bits(model, 99.0, &bits));
    CHECK(bits == (1 << 24) - 1);
    REFUSED(blysk_x_bits(model, INFINITY, &bits), BLYSK_CODE_X, "inf");
    REFUSED(blysk_x_bits(model, 0.5, NULL), BLYSK_CODE_NULL, "null");
    REFUSED(blysk_x_bits(NULL, 0.5, &bits), BLYSK_CODE_NULL, "the model");
    REFUSED(blysk_model_interface(NULL, NULL), BLYSK_CODE_NULL, "null");
}

enum { COUNT = 1000 };

static void arrays(const blysk_model *model)
{
    static int64_t x[COUNT], one[COUNT], each[COUNT];
    static uint32_t addresses[COUNT];
    static uint8_t status[COUNT];
    for (int i = 0; i < COUNT; i++) {
        x[i] = (int64_t)i * 16777 % (1 << 24);
        addresses[i] = 63;
    }
    OK(blysk_evaluate(model, addresses, 1, x, COUNT, one, status));
    OK(blysk_evaluate(model, addresses, COUNT, x, COUNT, each, status));
    CHECK(memcmp(one, each, sizeof one) == 0);
    CHECK(one[500] != one[499]);
    CHECK(status[COUNT - 1] == BLYSK_STATUS_ABOVE_ONE);
    uint32_t beyond = 1u << 31;
    OK(blysk_evaluate(model, &beyond, 1, x, COUNT, one, status));
    CHECK(one[COUNT / 2] == 0 && status[0] == BLYSK_STATUS_NO_WORD);
    OK(blysk_evaluate(model, &beyond, 1, NULL, 0, NULL, NULL));
    OK(blysk_evaluate(model, NULL, 0, NULL, 0, NULL, NULL));
    REFUSED(blysk_evaluate(model, addresses, 2, x, COUNT, one, status), BLYSK_CODE_ARGUMENT, "2 addresses for 1000 x");
    REFUSED(blysk_evaluate(NULL, addresses, 1, x, COUNT, one, status), BLYSK_CODE_NULL, "the model");
    REFUSED(blysk_evaluate(model, NULL, 1, x, COUNT, one, status), BLYSK_CODE_NULL, "the addresses");
    REFUSED(blysk_evaluate(model, addresses, 1, NULL, COUNT, one, status), BLYSK_CODE_NULL, "x is");
    REFUSED(blysk_evaluate(model, addresses, 1, x, COUNT, NULL, status), BLYSK_CODE_NULL, "intensities");
    REFUSED(blysk_evaluate(model, addresses, 1, x, COUNT, one, NULL), BLYSK_CODE_NULL, "status");
    REFUSED(blysk_evaluate(model, addresses, 1, x, (size_t)-1, one, status), BLYSK_CODE_ARGUMENT, "more than memory");
    x[17] = 1 << 24;
    REFUSED(blysk_evaluate(model, addresses, 1, x, COUNT, one, status), BLYSK_CODE_X, "sample 17");
}

static void registers(const blysk_model *model, const blysk_interface *ports)
{
    size_t count = ports->register_count;
    blysk_register *all = malloc(count * sizeof *all);
    CHECK(all != NULL && count > 10);
    if (all == NULL)
        return;
    uint32_t address = 63;
    int64_t x = 8304722, intensity;
    uint8_t status;
    OK(blysk_registers(model, address, x, all, count));
    OK(blysk_evaluate(model, &address, 1, &x, 1, &intensity, &status));
    size_t named = 0;
    for (size_t i = 0; i < count; i++) {
        CHECK(all[i].loaded && all[i].valid && all[i].rank < ports->latency && strlen(all[i].path) > 2);
        CHECK(i == 0 || all[i].rank >= all[i - 1].rank);
        CHECK(all[i].value == ldexp((double)all[i].bits, -(int)all[i].format.fraction_bits));
        if (all[i].rank == ports->latency - 1 && strstr(all[i].name, ".intensity") != NULL)
            named += all[i].bits == intensity;
        if (strcmp(all[i].path, "x_q") == 0)
            named += all[i].bits == x;
    }
    CHECK(named == 2);
    REFUSED(blysk_registers(model, address, x, all, count - 1), BLYSK_CODE_ARGUMENT, "room");
    REFUSED(blysk_registers(model, address, -1, all, count), BLYSK_CODE_X, "x");
    REFUSED(blysk_registers(model, address, x, NULL, count), BLYSK_CODE_NULL, "null");
    REFUSED(blysk_registers(NULL, address, x, all, count), BLYSK_CODE_NULL, "the model");
    free(all);
}

/* The ports of a pipeline as a scoreboard sees those of a DUT. */
static blysk_ports seen(const blysk_inputs *in, const blysk_outputs *out)
{
    return (blysk_ports){.reset = in->reset, .in_valid = in->in_valid, .in_ready = out->in_ready,
                         .out_valid = out->out_valid, .out_ready = in->out_ready, .address = in->address,
                         .x = (uint64_t)in->x, .intensity = (uint64_t)out->intensity, .status = out->status};
}

static blysk_inputs drive(unsigned cycle)
{
    return (blysk_inputs){.reset = cycle < 2 || cycle == 300, .in_valid = cycle % 7 != 0, .out_ready = cycle % 5 != 0,
                          .address = cycle % 256, .x = (int64_t)cycle * 30011 % (1 << 23)};
}

static void clocked(const blysk_model *model, const blysk_interface *ports)
{
    blysk_pipeline *pipeline, *twin;
    blysk_scoreboard *scoreboard;
    OK(blysk_pipeline_new(model, &pipeline));
    OK(blysk_pipeline_new(model, &twin));
    OK(blysk_scoreboard_new(model, &scoreboard));
    blysk_verdict verdict;
    OK(blysk_scoreboard_verdict(scoreboard, &verdict));
    CHECK(!verdict.passed && strncmp(verdict.line, "FAIL", 4) == 0);
    size_t count = ports->register_count;
    blysk_register *all = malloc(count * sizeof *all);
    CHECK(all != NULL);
    if (all == NULL)
        return;
    OK(blysk_pipeline_ranks(pipeline, all, count));
    CHECK(!all[0].loaded && !all[0].valid);

    static blysk_inputs inputs[COUNT];
    static blysk_outputs outputs[COUNT];
    for (unsigned cycle = 0; cycle < COUNT; cycle++) {
        inputs[cycle] = drive(cycle);
        blysk_outputs before, out;
        OK(blysk_pipeline_combinational(twin, &inputs[cycle], &before));
        OK(blysk_pipeline_clock(twin));
        OK(blysk_pipeline_tick(pipeline, &inputs[cycle], &out));
        CHECK(memcmp(&before.intensity, &out.intensity, sizeof out.intensity) == 0 && before.in_ready == out.in_ready);
        blysk_ports shown = seen(&inputs[cycle], &out);
        OK(blysk_scoreboard_cycle(scoreboard, &shown));
    }
    OK(blysk_scoreboard_verdict(scoreboard, &verdict));
    CHECK(verdict.passed && verdict.cycles == COUNT && verdict.results > 500 && verdict.stalls > 50);
    CHECK(verdict.resets == 1 && verdict.failures == 0 && strncmp(verdict.line, "PASS", 4) == 0);
    OK(blysk_pipeline_ranks(pipeline, all, count));
    CHECK(all[0].loaded);
    REFUSED(blysk_pipeline_ranks(pipeline, all, 0), BLYSK_CODE_ARGUMENT, "room");
    REFUSED(blysk_pipeline_ranks(NULL, all, count), BLYSK_CODE_NULL, "the pipeline");

    /* As new, and the same cycles in one call. */
    OK(blysk_pipeline_reset(pipeline));
    OK(blysk_pipeline_ranks(pipeline, all, count));
    CHECK(!all[0].loaded);
    OK(blysk_pipeline_run(pipeline, inputs, COUNT, outputs));
    blysk_inputs none = {.out_ready = true};
    blysk_outputs a, b;
    OK(blysk_pipeline_tick(pipeline, &none, &a));
    OK(blysk_pipeline_tick(twin, &none, &b));
    CHECK(a.intensity == b.intensity && a.out_valid == b.out_valid && a.status == b.status);

    /* A DUT with one wrong bit. */
    blysk_ports wrong = seen(&none, &a);
    wrong.in_ready = !wrong.in_ready;
    REFUSED(blysk_scoreboard_cycle(scoreboard, &wrong), BLYSK_CODE_DIFFERS, "in_ready_o is 0, expected 1");
    OK(blysk_scoreboard_verdict(scoreboard, &verdict));
    CHECK(!verdict.passed && verdict.failures == 1);

    inputs[0].x = -1;
    REFUSED(blysk_pipeline_tick(pipeline, &inputs[0], &a), BLYSK_CODE_X, "x");
    REFUSED(blysk_pipeline_run(pipeline, inputs, COUNT, outputs), BLYSK_CODE_X, "x");
    REFUSED(blysk_pipeline_tick(pipeline, NULL, &a), BLYSK_CODE_NULL, "the inputs");
    REFUSED(blysk_pipeline_tick(pipeline, &none, NULL), BLYSK_CODE_NULL, "null");
    REFUSED(blysk_pipeline_tick(NULL, &none, &a), BLYSK_CODE_NULL, "the pipeline");
    REFUSED(blysk_pipeline_combinational(NULL, &none, &a), BLYSK_CODE_NULL, "the pipeline");
    REFUSED(blysk_pipeline_clock(NULL), BLYSK_CODE_NULL, "the pipeline");
    REFUSED(blysk_pipeline_reset(NULL), BLYSK_CODE_NULL, "the pipeline");
    REFUSED(blysk_pipeline_run(pipeline, NULL, 1, outputs), BLYSK_CODE_NULL, "the inputs");
    blysk_pipeline_free(twin);
    REFUSED(blysk_pipeline_new(NULL, &twin), BLYSK_CODE_NULL, "the model");
    CHECK(twin == NULL);
    REFUSED(blysk_scoreboard_cycle(NULL, &wrong), BLYSK_CODE_NULL, "the scoreboard");
    REFUSED(blysk_scoreboard_cycle(scoreboard, NULL), BLYSK_CODE_NULL, "the ports");
    REFUSED(blysk_scoreboard_verdict(scoreboard, NULL), BLYSK_CODE_NULL, "the verdict");
    free(all);
    blysk_pipeline_free(pipeline);
    blysk_scoreboard_free(scoreboard);
}

/* The functions that SystemVerilog imports. */
static void words(const blysk_model *model, const blysk_interface *ports)
{
    uint64_t intensity = 0, again = 1;
    uint8_t status = 9, in_ready, out_valid = 0;
    OK(blysk_dpi_answer(model, 63, 8304722, &intensity, &status));
    CHECK(intensity > 0 && status == 0);
    blysk_pipeline *pipeline;
    OK(blysk_pipeline_new(model, &pipeline));
    for (unsigned cycle = 0; cycle <= ports->latency; cycle++)
        OK(blysk_dpi_tick(pipeline, 0, cycle == 0, 63, 8304722, 1, &in_ready, &out_valid, &again, &status));
    CHECK(out_valid == 1 && again == intensity);
    REFUSED(blysk_dpi_tick(NULL, 0, 1, 63, 0, 1, &in_ready, &out_valid, &again, &status), BLYSK_CODE_NULL, "pipeline");
    blysk_pipeline_free(pipeline);

    uint32_t address = ports->address.width, x = ports->x.width, out = ports->intensity.width;
    blysk_scoreboard *scoreboard;
    REFUSED(blysk_dpi_scoreboard_new(model, address, x + 1, out, ports->status.width, &scoreboard),
            BLYSK_CODE_DIFFERS, "x_i of the DUT");
    CHECK(scoreboard == NULL);
    OK(blysk_dpi_scoreboard_new(model, address, x, out, ports->status.width, &scoreboard));
    OK(blysk_dpi_cycle(scoreboard, 1, 3, 3, 0, 0, 0, 3, 3, 0, 0, 0));
    OK(blysk_dpi_cycle(scoreboard, 0, 1, 1, 1, 63, 8304722, 0, 1, 0, 0, 0));
    uint32_t none[4] = {0};
    REFUSED(blysk_dpi_registers(scoreboard, 1, 0, none), BLYSK_CODE_DIFFERS, "another configuration");
    uint32_t unknown[64];
    memset(unknown, 0xff, sizeof unknown);
    OK(blysk_dpi_registers(scoreboard, (uint32_t)ports->register_count, 0, unknown));
    OK(blysk_dpi_registers(scoreboard, (uint32_t)ports->register_count, UINT32_MAX, unknown));
    REFUSED(blysk_dpi_registers(scoreboard, (uint32_t)ports->register_count, 0, NULL), BLYSK_CODE_NULL, "the words");
    REFUSED(blysk_dpi_cycle(scoreboard, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0), BLYSK_CODE_DIFFERS, "is x, expected");
    REFUSED(blysk_dpi_cycle(scoreboard, 0, 3, 1, 1, 0, 0, 0, 1, 0, 0, 0), BLYSK_CODE_DIFFERS, "in_valid_i has an x");
    CHECK(strstr(blysk_dpi_summary(scoreboard), "4 cycles") != NULL);
    CHECK(strncmp(blysk_dpi_verdict(scoreboard), "FAIL 2 of 4 cycles", 18) == 0);
    CHECK(*blysk_dpi_verdict(NULL) == '\0' && *blysk_dpi_summary(NULL) == '\0');
    blysk_scoreboard_free(scoreboard);
}

int main(void)
{
    versions();
    constructors();
    blysk_model *model;
    blysk_interface ports;
    OK(blysk_model_preset(BLYSK_ABI_VERSION, "compact", &model));
    OK(blysk_model_interface(model, &ports));
    if (failures == 0) {
        real_numbers(model);
        arrays(model);
        registers(model, &ports);
        clocked(model, &ports);
        words(model, &ports);
    }
    blysk_model_free(model);
    printf("%u checks, %u failures\n", checks, failures);
    return failures == 0 ? 0 : 1;
}
