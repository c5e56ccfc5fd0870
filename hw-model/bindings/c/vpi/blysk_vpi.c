/* The scoreboard for simulators without DPI, such as Icarus Verilog, by VPI. blysk_vpi_checker.sv calls it.
 *
 *   iverilog-vpi blysk_vpi.c $(pkg-config --cflags --libs blysk)
 *   vvp -M. -mblysk_vpi simulation.vvp
 *
 * $blysk_scoreboard(configuration, address_i, x_i, intensity_o, status_o)   makes a scoreboard: its number, or 0
 * $blysk_watch(number, scope)          judges the registers below this scope of the DUT too: 1, or 0 where one is not
 *                                      there
 * $blysk_cycle(number, rst_i, in_valid_i, in_ready_o, address_i, x_i, out_valid_o, out_ready_i, intensity_o, status_o)
 *                                      judges a cycle: 0, or 1 where something differs
 *
 * Each prints FAIL with the reason where it fails. At the end of the simulation counts and verdict are printed.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <vpi_user.h>

#include "blysk.h"

enum { BOARDS = 16, PATH = 512, TOGETHER = 16 }; /* TOGETHER: registers in one call of blysk_dpi_registers */

static struct board {
    blysk_model *model;
    blysk_scoreboard *scoreboard;
    vpiHandle *watched; /* the DUT's registers, in the order of the model's; null where they are not watched */
    uint32_t count;
} boards[BOARDS];
static int made;

static void fail(const char *why)
{
    vpi_printf("FAIL %s\n", why);
}

/* ---- Arguments ------------------------------------------------------------------------------------------- */

static vpiHandle arguments(void)
{
    return vpi_iterate(vpiArgument, vpi_handle(vpiSysTfCall, NULL));
}

static void answer(PLI_INT32 number)
{
    s_vpi_value value = {.format = vpiIntVal, .value.integer = number};
    vpi_put_value(vpi_handle(vpiSysTfCall, NULL), &value, NULL, vpiNoDelay);
}

static PLI_INT32 number_of(vpiHandle argument)
{
    s_vpi_value value = {.format = vpiIntVal};
    vpi_get_value(argument, &value);
    return value.value.integer;
}

/* A text, cut to the room that there is. */
static void text_of(vpiHandle argument, char *text, size_t room)
{
    s_vpi_value value = {.format = vpiStringVal};
    vpi_get_value(argument, &value);
    snprintf(text, room, "%s", value.value.str);
}

/* A level: 0, 1, 2 for z, 3 for x, as VPI numbers them too. */
static uint8_t level_of(vpiHandle argument)
{
    s_vpi_value value = {.format = vpiScalarVal};
    vpi_get_value(argument, &value);
    return value.value.scalar == vpi0 || value.value.scalar == vpi1 ? (uint8_t)value.value.scalar : 3;
}

/* A word of at most 64 bits into two pairs of values and marks of x and z. */
static void pairs_of(vpiHandle argument, uint32_t pairs[4])
{
    s_vpi_value value = {.format = vpiVectorVal};
    vpi_get_value(argument, &value);
    bool wide = vpi_get(vpiSize, argument) > 32;
    pairs[0] = (uint32_t)value.value.vector[0].aval;
    pairs[1] = (uint32_t)value.value.vector[0].bval;
    pairs[2] = wide ? (uint32_t)value.value.vector[1].aval : 0;
    pairs[3] = wide ? (uint32_t)value.value.vector[1].bval : 0;
}

static uint64_t word_of(vpiHandle argument, bool *known)
{
    uint32_t pairs[4];
    pairs_of(argument, pairs);
    *known = *known && pairs[1] == 0 && pairs[3] == 0;
    return (uint64_t)pairs[2] << 32 | pairs[0];
}

static struct board *board_of(vpiHandle argument)
{
    PLI_INT32 number = number_of(argument);
    return number >= 1 && number <= made ? &boards[number - 1] : NULL;
}

/* ---- Functions ------------------------------------------------------------------------------------------- */

static PLI_INT32 new_scoreboard(PLI_BYTE8 *data)
{
    (void)data;
    vpiHandle all = arguments();
    char configuration[PATH];
    text_of(vpi_scan(all), configuration, sizeof configuration);
    uint32_t widths[4];
    for (int i = 0; i < 4; i++)
        widths[i] = (uint32_t)vpi_get(vpiSize, vpi_scan(all));
    vpi_free_object(all);
    if (made == BOARDS) {
        fail("there are 16 scoreboards already");
        answer(0);
        return 0;
    }
    struct board *board = &boards[made];
    blysk_code code = strstr(configuration, ".json") != NULL
                          ? blysk_model_from_file(BLYSK_ABI_VERSION, configuration, &board->model)
                          : blysk_model_preset(BLYSK_ABI_VERSION, configuration, &board->model);
    if (code == BLYSK_CODE_OK)
        code = blysk_dpi_scoreboard_new(board->model, widths[0], widths[1], widths[2], widths[3], &board->scoreboard);
    if (code != BLYSK_CODE_OK) {
        fail(blysk_last_error());
        blysk_model_free(board->model);
        answer(0);
        return 0;
    }
    made++;
    answer(made);
    return 0;
}

/* Finds every register of the model in the DUT. */
static bool find(struct board *board, const char *scope)
{
    blysk_interface ports;
    if (blysk_model_interface(board->model, &ports) != BLYSK_CODE_OK)
        return false;
    size_t count = ports.register_count;
    blysk_register *registers = calloc(count, sizeof *registers);
    board->watched = calloc(count, sizeof *board->watched);
    bool found = registers != NULL && board->watched != NULL &&
                 blysk_registers(board->model, 0, 0, registers, count) == BLYSK_CODE_OK;
    for (size_t i = 0; found && i < count; i++) {
        char path[PATH];
        snprintf(path, sizeof path, "%s.%s", scope, registers[i].path);
        board->watched[i] = vpi_handle_by_name(path, NULL);
        found = board->watched[i] != NULL;
        if (!found)
            vpi_printf("FAIL there is no register %s\n", path);
    }
    free(registers);
    board->count = found ? (uint32_t)count : 0;
    return found;
}

static PLI_INT32 watch(PLI_BYTE8 *data)
{
    (void)data;
    vpiHandle all = arguments();
    struct board *board = board_of(vpi_scan(all));
    char scope[PATH / 2];
    text_of(vpi_scan(all), scope, sizeof scope);
    vpi_free_object(all);
    answer(board != NULL && find(board, scope));
    return 0;
}

static PLI_INT32 cycle(PLI_BYTE8 *data)
{
    (void)data;
    vpiHandle all = arguments();
    struct board *board = board_of(vpi_scan(all));
    bool request = true, result = true;
    uint8_t reset = level_of(vpi_scan(all));
    uint8_t in_valid = level_of(vpi_scan(all));
    uint8_t in_ready = level_of(vpi_scan(all));
    uint32_t address = (uint32_t)word_of(vpi_scan(all), &request);
    uint64_t x = word_of(vpi_scan(all), &request);
    uint8_t out_valid = level_of(vpi_scan(all));
    uint8_t out_ready = level_of(vpi_scan(all));
    uint64_t intensity = word_of(vpi_scan(all), &result);
    uint64_t status = word_of(vpi_scan(all), &result);
    vpi_free_object(all);
    blysk_code code = BLYSK_CODE_NULL;
    if (board != NULL) {
        for (uint32_t first = 0; first < board->count; first += TOGETHER) {
            uint32_t words[4 * TOGETHER];
            for (uint32_t i = 0; i < TOGETHER && first + i < board->count; i++)
                pairs_of(board->watched[first + i], &words[4 * i]);
            blysk_dpi_registers(board->scoreboard, board->count, first, words);
        }
        code = blysk_dpi_cycle(board->scoreboard, reset, in_valid, in_ready, request, address, x, out_valid, out_ready,
                               result, intensity, status);
    }
    if (code != BLYSK_CODE_OK)
        fail(board == NULL ? "there is no such scoreboard" : blysk_last_error());
    answer(code != BLYSK_CODE_OK);
    return 0;
}

/* ---- The end --------------------------------------------------------------------------------------------- */

static PLI_INT32 end(p_cb_data data)
{
    (void)data;
    for (int i = 0; i < made; i++) {
        struct board *board = &boards[i];
        vpi_printf("%s\n", blysk_dpi_summary(board->scoreboard));
        vpi_printf("%s\n", blysk_dpi_verdict(board->scoreboard));
        blysk_scoreboard_free(board->scoreboard);
        blysk_model_free(board->model);
        free(board->watched);
    }
    made = 0;
    return 0;
}

static void add(const char *name, PLI_INT32 (*function)(PLI_BYTE8 *))
{
    s_vpi_systf_data data = {.type = vpiSysFunc, .sysfunctype = vpiIntFunc, .tfname = name, .calltf = function};
    vpi_register_systf(&data);
}

static void start(void)
{
    add("$blysk_scoreboard", new_scoreboard);
    add("$blysk_watch", watch);
    add("$blysk_cycle", cycle);
    s_cb_data data = {.reason = cbEndOfSimulation, .cb_rtn = end};
    vpi_register_cb(&data);
}

void (*vlog_startup_routines[])(void) = {start, NULL};
