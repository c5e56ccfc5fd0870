/* The golden model of Blysk and its clocked pipeline, for C and C++.
 *
 * Made by: make header (cbindgen, of hw-model/bindings/c/src/); do not edit.
 *
 * Functions return a code, and write what they find where their last arguments point. After a code other than
 * BLYSK_CODE_OK blysk_last_error() has the sentence, each thread its own. What a function does not write after an
 * error is left as it was, unless its text says otherwise.
 *
 * Null where a pointer must not be null is an error and no crash. A pointer that is neither null nor right, a handle
 * that was freed, a text without its zero byte are not noticed.
 *
 * Numbers are bits: integers of which a port's or register's format says the value. Words are what wires carry: bits
 * of the format's width, two's complement, the rest zero.
 *
 * Link with -lblysk; `pkg-config --cflags --libs blysk` has the rest.
 */

#ifndef BLYSK_H
#define BLYSK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The version of this header. Another number means that functions, structures or codes are not those of this header;
// constructors refuse it.
#define BLYSK_ABI_VERSION 1

// A flag of the status: the address has no ROM word; the intensity is 0.
#define BLYSK_STATUS_NO_WORD 1

// A flag of the status: x was above 1 and was taken as 1.
#define BLYSK_STATUS_ABOVE_ONE 2

// A flag of the status: x was negative; the intensity is 0.
#define BLYSK_STATUS_FACING_AWAY 4

// A flag of the status: the polynomial left [0, 1] and was clamped.
#define BLYSK_STATUS_CLAMPED 8

// A flag of the status: x lies outside the domain that the configuration is built for; the intensity is 0.
#define BLYSK_STATUS_OUT_OF_DOMAIN 16

// How a call went. Each code keeps its number in every version.
typedef enum {
    // The work is done.
    BLYSK_CODE_OK = 0,
    // There is no preset of this name.
    BLYSK_CODE_NO_PRESET = 1,
    // The text is no configuration, or the file cannot be read.
    BLYSK_CODE_CONFIGURATION = 2,
    // The configuration gives no hardware.
    BLYSK_CODE_DESIGN = 3,
    // The ROM has no word for the exponent.
    BLYSK_CODE_EXPONENT = 4,
    // x is not finite, or its bits do not fit the input format.
    BLYSK_CODE_X = 5,
    // An address is out of range, or lengths do not go together.
    BLYSK_CODE_ARGUMENT = 6,
    // A pointer is null that must not be.
    BLYSK_CODE_NULL = 7,
    // A text is not UTF-8.
    BLYSK_CODE_TEXT = 8,
    // The caller was compiled with the header of another version.
    BLYSK_CODE_ABI = 9,
    // A scoreboard: the DUT does not do what the model does.
    BLYSK_CODE_DIFFERS = 10,
    // A mistake inside the library. The handles of the call may only be freed.
    BLYSK_CODE_INTERNAL = 11,
} blysk_code;

// The golden model of one configuration.
//
// It never changes, so that any number of threads may ask one model at a time. Pipelines and scoreboards keep what
// they need of it: it may be freed before them.
typedef struct blysk_model blysk_model;

// The clocked pipeline of a model: its registers, and one call a clock cycle.
//
// One thread at a time may use a pipeline; different threads may use different pipelines of one model.
typedef struct blysk_pipeline blysk_pipeline;

// Judges a DUT: holds its ports against the clocked model's in every cycle from the first reset on.
//
// One thread at a time may use a scoreboard.
typedef struct blysk_scoreboard blysk_scoreboard;

// A fixed-point format: a value is `bits / 2^fraction_bits`.
typedef struct {
    // Bits in all, the sign included: 1 to 63.
    uint32_t width;
    // Bits before the point, the sign included. It may be negative: then leading fraction bits are left out.
    int32_t integer_bits;
    // Bits behind the point.
    uint32_t fraction_bits;
    // Whether the highest bit is a sign.
    bool is_signed;
} blysk_format;

// The ports of a pipeline, its latency and its sizes.
typedef struct {
    // Format of the port `address_i`.
    blysk_format address;
    // Format of the port `x_i`.
    blysk_format x;
    // Format of the port `intensity_o`.
    blysk_format intensity;
    // Format of the port `status_o`.
    blysk_format status;
    // Clock cycles from a request to its result, which is the number of ranks.
    uint32_t latency;
    // Words of the ROM; addresses from there on have none.
    uint32_t depth;
    // Registers of all ranks: what `blysk_registers` and `blysk_pipeline_ranks` write.
    size_t register_count;
} blysk_interface;

// A register of a rank, and what it holds.
typedef struct {
    // Its name with its part's, as in traces and waves: `stage1.t1`. The bytes stay as long as the model, or a
    // pipeline or scoreboard made of it.
    const char *name;
    // Its path in the RTL below the top module: `polynomial.stage[1].multiply_add.t_q`. The bytes stay as those of
    // the name.
    const char *path;
    // The rank that it stands in, counted from 0.
    uint32_t rank;
    // Its format.
    blysk_format format;
    // False until the rank has loaded a request: the RTL shows unknown bits there, and `bits` is 0.
    bool loaded;
    // The valid flag of its rank: whether the rank holds a request now.
    bool valid;
    // Its bits: the integer that they mean in its format.
    int64_t bits;
    // Its value: `bits / 2^fraction_bits`.
    double value;
} blysk_register;

// What drives the ports during one clock cycle.
typedef struct {
    // `rst_i`: clears every valid flag at the edge.
    bool reset;
    // `in_valid_i`: `address` and `x` are a request.
    bool in_valid;
    // `out_ready_i`: a result can be taken.
    bool out_ready;
    // `address_i`: the ROM address.
    uint32_t address;
    // `x_i`: bits in the input format.
    int64_t x;
} blysk_inputs;

// What the ports show at the rising edge that ends the cycle.
typedef struct {
    // `in_ready_o`: a request is taken.
    bool in_ready;
    // `out_valid_o`: `intensity` and `status` are a result.
    bool out_valid;
    // `status_o`: flags, `BLYSK_STATUS_…`.
    uint8_t status;
    // `intensity_o`: bits in the output format.
    int64_t intensity;
} blysk_outputs;

// The ports of a DUT at a rising edge: what drives them and what they show.
typedef struct {
    // `rst_i`.
    bool reset;
    // `in_valid_i`.
    bool in_valid;
    // `in_ready_o`.
    bool in_ready;
    // `out_valid_o`.
    bool out_valid;
    // `out_ready_i`.
    bool out_ready;
    // `address_i`.
    uint32_t address;
    // `x_i`: the word on the port, two's complement; bits above its width are ignored.
    uint64_t x;
    // `intensity_o`: the word on the port.
    uint64_t intensity;
    // `status_o`: the word on the port.
    uint64_t status;
} blysk_ports;

// What a scoreboard has found so far.
typedef struct {
    // Whether results were taken, and nothing differed.
    bool passed;
    // Clock cycles seen.
    uint64_t cycles;
    // Results taken.
    uint64_t results;
    // Cycles in which a result waited.
    uint64_t stalls;
    // Cycles in which a request could have been taken and there was none.
    uint64_t bubbles;
    // Times that reset went high, after the first.
    uint64_t resets;
    // Values held against the model's: results and, where they were shown, registers.
    uint64_t compared;
    // Cycles in which something differed.
    uint64_t failures;
    // `PASS 4096 results`, or `FAIL` with the reason. The bytes stay until the next call with this scoreboard.
    const char *line;
} blysk_verdict;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The sentence to the last code of this thread that was not `BLYSK_CODE_OK`, the same that the command `blysk` says;
// an empty text where there was none. Its bytes stay until the next call of this thread that fails, or the thread
// ends. Thread-safe: each thread has its own.
const char *blysk_last_error(void);

// The version of the ABI that the library was built with: `BLYSK_ABI_VERSION` of its own header. Thread-safe.
uint32_t blysk_abi_version(void);

// The version of Blysk, such as `0.1.0`. Its bytes stay for good. Thread-safe.
const char *blysk_version(void);

// Makes the model of a preset, such as `compact`; `blysk presets` lists them.
//
// `abi` is `BLYSK_ABI_VERSION` of the header that the caller was compiled with. `*model` is to be freed with
// `blysk_model_free`; after an error it is null. Thread-safe.
blysk_code blysk_model_preset(uint32_t abi, const char *name, blysk_model **model);

// Makes the model of a configuration as JSON text; `docs/CONFIGURATION.md` has its fields. As `blysk_model_preset`
// else. Thread-safe.
blysk_code blysk_model_from_json(uint32_t abi,
                                 const char *json,
                                 blysk_model **model);

// Makes the model of a configuration in a file of JSON. As `blysk_model_preset` else. Thread-safe.
blysk_code blysk_model_from_file(uint32_t abi, const char *path, blysk_model **model);

// Frees a model; null is left alone. No other thread may be using it.
void blysk_model_free(blysk_model *model);

// Writes the formats of the ports, the latency and the sizes of the pipeline. Thread-safe.
blysk_code blysk_model_interface(const blysk_model *model, blysk_interface *interface);

// Writes the intensity, in [0, 1], that the hardware answers to the exponent `n` and `x` = cos γ.
//
// `x` is rounded to the input format, and brought to its ends where it lies outside. An `n` without a ROM word is
// `BLYSK_CODE_EXPONENT`, an `x` that is not finite `BLYSK_CODE_X`. Thread-safe.
blysk_code blysk_highlight(const blysk_model *model,
                           double n,
                           double x,
                           double *intensity);

// Writes the ROM address of the exponent `n`, for `blysk_evaluate` and for the port `address_i`. An `n` without a
// ROM word is `BLYSK_CODE_EXPONENT`. Thread-safe.
blysk_code blysk_address(const blysk_model *model,
                         double n,
                         uint32_t *address);

// Writes the bits of a real `x` in the input format: the nearest, a tie to even; the format's end for an `x` beyond
// it. An `x` that is not finite is `BLYSK_CODE_X`. Thread-safe.
blysk_code blysk_x_bits(const blysk_model *model,
                        double x,
                        int64_t *bits);

// Answers `count` requests, bit for bit as the hardware does.
//
// `addresses` has `address_count` ROM addresses: 1 for all requests, or `count`, one for each; an address without a
// ROM word is no error but a flag of the status. `x` has `count` values, bits in the input format; bits that it does
// not hold are `BLYSK_CODE_X`, and the sentence names the first such sample. `intensity` and `status` have room for
// `count` values each: bits in the output format, and flags (`BLYSK_STATUS_…`). After an error they hold nothing of
// use. The four arrays may not overlap. Thread-safe.
blysk_code blysk_evaluate(const blysk_model *model,
                          const uint32_t *addresses,
                          size_t address_count,
                          const int64_t *x,
                          size_t count,
                          int64_t *intensity,
                          uint8_t *status);

// Writes what every register holds of one request on its way from the first rank to the last.
//
// `registers` has room for `room` of them, at least `register_count` of the interface: they are written in the order
// of ranks. `x` is bits in the input format. Thread-safe.
blysk_code blysk_registers(const blysk_model *model,
                           uint32_t address,
                           int64_t x,
                           blysk_register *registers,
                           size_t room);

// Makes an empty pipeline, as after reset. `*pipeline` is to be freed with `blysk_pipeline_free`; after an error it
// is null. Thread-safe.
blysk_code blysk_pipeline_new(const blysk_model *model,
                              blysk_pipeline **pipeline);

// Frees a pipeline; null is left alone.
void blysk_pipeline_free(blysk_pipeline *pipeline);

// Makes the pipeline as new: empty, and no rank has loaded anything. (`reset` of the inputs is what hardware does: it
// clears flags and leaves data.)
blysk_code blysk_pipeline_reset(blysk_pipeline *pipeline);

// One clock cycle: writes what the ports show with these inputs at the rising edge that ends the cycle; then the edge.
//
// Bits of x that the input format does not hold are `BLYSK_CODE_X`, and then no cycle has passed.
blysk_code blysk_pipeline_tick(blysk_pipeline *pipeline,
                               const blysk_inputs *inputs,
                               blysk_outputs *outputs);

// Writes what the ports show with these inputs before the edge, which `blysk_pipeline_clock` then brings. It may be
// called as often as the inputs change within a cycle.
blysk_code blysk_pipeline_combinational(blysk_pipeline *pipeline,
                                        const blysk_inputs *inputs,
                                        blysk_outputs *outputs);

// The rising edge, with the inputs of the last `blysk_pipeline_combinational`.
blysk_code blysk_pipeline_clock(blysk_pipeline *pipeline);

// `blysk_pipeline_tick` for `count` cycles: `inputs` has one element a cycle, and `outputs` room for as many. The
// arrays may not overlap. Where an x does not fit, the cycles before it have passed.
blysk_code blysk_pipeline_run(blysk_pipeline *pipeline,
                              const blysk_inputs *inputs,
                              size_t count,
                              blysk_outputs *outputs);

// Writes what every register holds before the next edge. `registers` has room for `room` of them, at least
// `register_count` of the interface: they are written in the order of ranks.
blysk_code blysk_pipeline_ranks(blysk_pipeline *pipeline, blysk_register *registers, size_t room);

// Makes a scoreboard. `*scoreboard` is to be freed with `blysk_scoreboard_free`; after an error it is null.
// Thread-safe.
blysk_code blysk_scoreboard_new(const blysk_model *model, blysk_scoreboard **scoreboard);

// Frees a scoreboard; null is left alone.
void blysk_scoreboard_free(blysk_scoreboard *scoreboard);

// Judges one clock cycle by the ports at the rising edge that ends it.
//
// `BLYSK_CODE_DIFFERS` says that the DUT does something else than the model; `blysk_last_error` then tells cycle,
// port or register, request, and what was expected. Later cycles are judged all the same. Cycles before the end of
// the first reset are not compared: hardware may show anything there.
blysk_code blysk_scoreboard_cycle(blysk_scoreboard *scoreboard,
                                  const blysk_ports *ports);

// Writes what the scoreboard has found so far.
blysk_code blysk_scoreboard_verdict(blysk_scoreboard *scoreboard, blysk_verdict *verdict);

// `blysk_scoreboard_new` for a DUT with ports of these widths in bits: other widths than the model's are
// `BLYSK_CODE_DIFFERS`. Thread-safe.
blysk_code blysk_dpi_scoreboard_new(const blysk_model *model,
                                    uint32_t address_width,
                                    uint32_t x_width,
                                    uint32_t intensity_width,
                                    uint32_t status_width,
                                    blysk_scoreboard **scoreboard);

// `blysk_scoreboard_cycle` of a four-valued simulator. Single bits are 0, 1, 2 for z or 3 for x. The request and the
// result are known where none of their bits is x or z: `request_known` and `result_known` are 1, and 0 otherwise.
blysk_code blysk_dpi_cycle(blysk_scoreboard *scoreboard,
                           uint8_t reset,
                           uint8_t in_valid,
                           uint8_t in_ready,
                           uint8_t request_known,
                           uint32_t address,
                           uint64_t x,
                           uint8_t out_valid,
                           uint8_t out_ready,
                           uint8_t result_known,
                           uint64_t intensity,
                           uint64_t status);

// What the DUT's registers hold at the edge that the next `blysk_dpi_cycle` judges: of `count` in all, in the order of
// `blysk_registers`, the 16 from `first` on, or as many as are left.
//
// `words` has 64 bits of a `logic` vector for each, the first register lowest: two pairs of 32 values and 32 marks of
// z and x, as `svLogicVecVal` has them. Registers that no call tells are unknown.
blysk_code blysk_dpi_registers(blysk_scoreboard *scoreboard,
                               uint32_t count,
                               uint32_t first,
                               const uint32_t *words);

// What was seen so far: `6449 cycles, 1051 stalls, 972 bubbles, 3 resets, 40960 values compared`; an empty text for
// null. The bytes stay until the next call of this function with this scoreboard.
const char *blysk_dpi_summary(blysk_scoreboard *scoreboard);

// `PASS 4096 results`, or `FAIL` with the reason; an empty text for null. The bytes stay until the next call of this
// function with this scoreboard.
const char *blysk_dpi_verdict(blysk_scoreboard *scoreboard);

// `blysk_pipeline_tick` with words: x as it is on the port, two's complement; bits above its width are ignored.
blysk_code blysk_dpi_tick(blysk_pipeline *pipeline,
                          uint8_t reset,
                          uint8_t in_valid,
                          uint32_t address,
                          uint64_t x,
                          uint8_t out_ready,
                          uint8_t *in_ready,
                          uint8_t *out_valid,
                          uint64_t *intensity,
                          uint8_t *status);

// The word on `intensity_o` and the flags on `status_o` that answer one request, without a clock. Thread-safe.
blysk_code blysk_dpi_answer(const blysk_model *model,
                            uint32_t address,
                            uint64_t x,
                            uint64_t *intensity,
                            uint8_t *status);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* BLYSK_H */
