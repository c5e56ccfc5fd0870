// Self-checking testbench of [[ dut ]], a module of another latency or with other ports, for the configuration
// "[[ configuration ]]".
// Made by: [[ command ]]
//
// What it takes for granted:
<%- for assumption in assumptions %>
//   - [[ assumption ]]
<%- endfor %>
//
// First it looks at its assumptions: some vectors without stalls, every output of every cycle kept. Where the answers
// come at another time, where a flag or the status is not what it is taken for, or where nothing comes at all, it says
// which assumption fails, and ends. Then every vector is sent with stalls, bubbles and resets, as far as the ports have
// them, from the seed; what a reset loses is sent again. X is never right (`!==`). Ends with one line,
// "PASS <count> vectors" or "FAIL ...".
//
// Options:
//   +seed=N           another order of stalls, bubbles and resets (1)
//   +plain            no stalls, bubbles or resets
//   +expected=FILE    other answers (expected.mem); negative_control.mem must FAIL
//   +waves=FILE       dump waves
//   +log=FILE         write every answer as CSV for `blysk check`, and do not stop at the first wrong one
`timescale 1ns / 1ps
`default_nettype none

// One process judges and drives, and its tasks go on with what those before them have set in the same cycle: blocking
// assignments to its own state, others to what the DUT reads.
// verilator lint_off BLKSEQ
module blysk_tb;

  localparam int VECTORS  = [[ vectors ]];
  localparam int DEPTH    = [[ depth ]];
  localparam int ADDRESS  = [[ address.width ]];
  localparam int INPUT    = [[ x.width ]];
  localparam int OUTPUT   = [[ intensity.width ]];
  localparam int STATUS   = [[ status_width ]];
  localparam int LATENCY  = [[ latency ]];
  // Requests of a run at the least: enough for blocks with stalls, with bubbles, with both, and resets.
  localparam int REQUESTS = 2048;
  // A word that no file wrote keeps its mark, which lies above the bits of the word.
  localparam int MARK     = 4;

  // ---- What the ports have ------------------------------------------------------------------------
  localparam logic HAS_RESET     = [[ has.reset ]];
  localparam logic HAS_IN_READY  = [[ has.in_ready ]];
  localparam logic HAS_OUT_VALID = [[ has.out_valid ]];
  localparam logic HAS_OUT_READY = [[ has.out_ready ]];
  localparam logic HAS_STATUS    = [[ has.status ]];
  // Without in_ready, out_ready is an enable: nothing moves where it is low.
  localparam logic IS_ENABLE     = HAS_OUT_READY && !HAS_IN_READY;
  // Where nothing can wait, every answer has its cycle.
  localparam logic IS_TIMED      = !(HAS_IN_READY && HAS_OUT_READY);

  // ---- The look at the assumptions ----------------------------------------------------------------
  localparam int PROBE   = VECTORS < 256 ? VECTORS : 256;
  // How many cycles earlier or later an answer is looked for.
  localparam int REACH   = 64;
  localparam int HISTORY = 4 * PROBE + LATENCY + 2 * REACH;
  logic [OUTPUT-1:0]  seen_intensity[0:HISTORY-1];
  logic [STATUS-1:0]  seen_status   [0:HISTORY-1];
  logic               seen_valid    [0:HISTORY-1];
  logic               was_taken     [0:HISTORY-1];
  integer             taken_at      [0:PROBE-1];
  logic               probing;

  // ---- Vectors ------------------------------------------------------------------------------------
  logic [MARK+ADDRESS+INPUT-1:0] stimulus [0:VECTORS-1];
  logic [MARK+STATUS+OUTPUT-1:0] expected [0:VECTORS-1];
  logic [MARK+63:0]              exponents[0:DEPTH-1];

  // ---- Options --------------------------------------------------------------------------------------
  string       expected_file, waves_file, log_file;
  integer      seed, log, total, i;
  logic        plain;
  // The state of the random numbers.
  logic [31:0] random;

  // ---- The scoreboard -------------------------------------------------------------------------------
  // Cycles in which the DUT moves, and the one in which each request under way was taken, the oldest first in a ring.
  localparam int DEEP = 1024 + 2 * LATENCY;
  integer      tick, oldest, under_way;
  integer      since[0:DEEP-1];
  integer      sent, received, cycle, stalls, bubbles, resets, reset_left, idle, failures, words_compared;
  logic [2:0]  mode;
  logic        waits, ended, stalled, enabled, taken;
  logic [OUTPUT+STATUS-1:0] stalled_answer;
  string       first_failure;

<% include "tb_clock.sv" %>

<%- for wire in wires %>
  [[ wire ]]
<%- endfor %>

  [[ dut ]] dut (
    [[ connections ]]
  );

  // ---- Begin, end, and the files --------------------------------------------------------------------
  // The rest of the cycle must say nothing more.
  task automatic stop;
    ended = 1'b1;
  endtask

<% include "tb_complete.sv" %>

  task automatic start;
    tick = 0; oldest = 0; under_way = 0; sent = 0; received = 0; cycle = 0; stalls = 0; bubbles = 0; resets = 0; idle = 0; mode = '0;
    words_compared = 0; failures = 0; waits = 1'b0; stalled = 1'b0;
    reset_left = HAS_RESET ? 4 : 0;
  endtask

  initial begin
    ended = 1'b0; probing = 1'b1; rst = HAS_RESET; in_valid = 1'b0; address = '0; x = '0; out_ready = 1'b1;
    start;
    if (!$value$plusargs("seed=%d", seed)) seed = 1;
    if (!$value$plusargs("expected=%s", expected_file)) expected_file = "expected.mem";
    plain = $test$plusargs("plain") != 0;
    random = seed * 32'h9e3779b9 + 32'h7f4a7c15;
    if (random == 0) random = 1;
    for (i = 0; i < VECTORS; i = i + 1) begin
      stimulus[i] = '1;
      expected[i] = '1;
    end
    for (i = 0; i < DEPTH; i = i + 1) exponents[i] = '1;
    for (i = 0; i < HISTORY; i = i + 1) begin
      seen_valid[i] = 1'b0;
      was_taken[i]  = 1'b0;
    end
    $readmemh("stimulus.mem", stimulus, 0, VECTORS - 1);
    $readmemh(expected_file, expected, 0, VECTORS - 1);
    $readmemh("exponents.mem", exponents, 0, DEPTH - 1);
    for (i = 0; i < VECTORS; i = i + 1) begin
      complete(stimulus[i][MARK+ADDRESS+INPUT-1], ^stimulus[i], "stimulus.mem", i);
      complete(expected[i][MARK+STATUS+OUTPUT-1], ^expected[i], expected_file, i);
    end
    for (i = 0; i < DEPTH; i = i + 1) complete(exponents[i][MARK+63], ^exponents[i], "exponents.mem", i);
    total = VECTORS;
    while (!plain && total < REQUESTS && VECTORS > 0) total = total + VECTORS;
    if ($value$plusargs("waves=%s", waves_file)) begin
      $dumpfile(waves_file);
      $dumpvars;
    end
    log = 0;
    if ($value$plusargs("log=%s", log_file)) begin
      log = $fopen(log_file, "w");
      if (log == 0) begin
        $display("FAIL cannot write %0s", log_file);
        stop;
      end
      $fwrite(log, "index,intensity[[ log_status ]]\n");
    end
  end

  // ---- Random numbers: xorshift, the same in every simulator ----------------------------------------
<% include "tb_draw.sv" %>

  // ---- Failures -------------------------------------------------------------------------------------
<% include "tb_value.sv" %>

  task automatic fail(input integer index, input string where, input logic [63:0] got, input logic [63:0] wanted,
                      input integer width, input integer fraction);
    logic [ADDRESS-1:0] fail_address;
    logic [INPUT-1:0]   fail_x;
    real                exponent;
    failures = failures + 1;
    if (failures == 1) begin
      {fail_address, fail_x} = stimulus[index][ADDRESS+INPUT-1:0];
      exponent = 0.0;
      if (32'(fail_address) < DEPTH) exponent = $bitstoreal(exponents[32'(fail_address)][63:0]);
      first_failure = $sformatf("vector %0d: address %0d (n = %0g), x = %0d'h%h (%0.9g), cycle %0d: dut.%0s is %0d'h%0h (%0.9g), expected %0d'h%0h (%0.9g)",
        index, fail_address, exponent, INPUT, fail_x,
        value(64'(fail_x), INPUT, [[ x.signed ]], [[ x.fraction ]]), cycle, where,
        width, got, value(got, width, 0, fraction), width, wanted, value(wanted, width, 0, fraction));
    end
    if (log == 0) begin
      $display("FAIL %0s", first_failure);
      stop;
    end
  endtask

  // Intensity and status of an answer against those of a vector.
  task automatic compare(input integer index, input logic [OUTPUT-1:0] got, input logic [STATUS-1:0] flags);
    if (got !== expected[index][OUTPUT-1:0] && !ended)
      fail(index, "intensity", 64'(got), 64'(expected[index][OUTPUT-1:0]), OUTPUT, [[ intensity.fraction ]]);
    if (HAS_STATUS && flags !== expected[index][STATUS+OUTPUT-1:OUTPUT] && !ended)
      fail(index, "status", 64'(flags), 64'(expected[index][STATUS+OUTPUT-1:OUTPUT]), STATUS, 0);
    words_compared = words_compared + 1 + 32'(HAS_STATUS);
  endtask

  // ---- Which assumption fails -----------------------------------------------------------------------
  // How many of the first `count` answers are seen `offset` cycles from where they belong; of the intensity alone.
  function automatic integer agreeing(input integer count, input integer offset);
    integer k, at;
    agreeing = 0;
    for (k = 0; k < count; k = k + 1) begin
      at = taken_at[k] + LATENCY + offset;
      if (at >= 0 && at < HISTORY && seen_intensity[at] === expected[k][OUTPUT-1:0]) agreeing = agreeing + 1;
    end
  endfunction

  // How many cycles the flag differs from requests that were taken LATENCY + `offset` cycles before.
  function automatic integer misplaced(input integer offset);
    integer k, from;
    misplaced = 0;
    for (k = 0; k < HISTORY; k = k + 1) begin
      from = k - LATENCY - offset;
      if (seen_valid[k] !== (from >= 0 && from < HISTORY ? was_taken[from] : 1'b0)) misplaced = misplaced + 1;
    end
  endfunction

  task automatic said(input integer offset);
    string  unit, side;
    integer apart;
    unit = offset == 1 || offset == -1 ? "cycle" : "cycles";
    side = offset < 0 ? "early" : "late";
    apart = offset < 0 ? -offset : offset;
    $display("FAIL latency: answers come %0d %0s %0s, after %0d and not after %0d: --dut-latency %0d",
      apart, unit, side, LATENCY + offset, LATENCY, LATENCY + offset);
    stop;
  endtask

  task automatic judge_assumptions;
    integer count, offset, here, best, best_offset, flags, unknown, right_status;
    count = 0;
    flags = 0;
    unknown = 0;
    for (i = 0; i < HISTORY; i = i + 1) begin
      if (was_taken[i]) count = count + 1;
      if (seen_valid[i] === 1'b1) flags = flags + 1;
      if (^seen_intensity[i] === 1'bx) unknown = unknown + 1;
    end
    if (count > PROBE) count = PROBE;
    here = agreeing(count, 0);
    best = here;
    best_offset = 0;
    for (i = 1; i <= REACH; i = i + 1) begin
      for (offset = -i; offset <= i; offset = offset + 2 * i) begin
        if (LATENCY + offset >= 0 && agreeing(count, offset) > best) begin
          best = agreeing(count, offset);
          best_offset = offset;
        end
      end
    end
    if (count == 0) begin
      $display("FAIL [[ name.in_ready ]] was never 1 in %0d cycles: no request was taken; [[ name.reset ]]?",
        HISTORY);
      stop;
    end else if (HAS_OUT_VALID && flags == 0) begin
      $display("FAIL [[ name.out_valid ]] was never 1 in %0d cycles after %0d requests; [[ name.reset ]], and is [[ name.in_valid ]] the right port?",
        HISTORY, count);
      stop;
    end else if (unknown == HISTORY) begin
      $display("FAIL [[ name.intensity ]] has unknown bits (x) in every cycle; is [[ name.clock ]] the clock, and every input connected?");
      stop;
    end else if (best_offset != 0 && 2 * best > count) begin
      said(best_offset);
    end else if (HAS_OUT_VALID && 2 * here > count && misplaced(0) != 0) begin
      best = misplaced(0);
      for (offset = -REACH; offset <= REACH; offset = offset + 1) begin
        if (LATENCY + offset >= 0 && misplaced(offset) < best) begin
          best = misplaced(offset);
          best_offset = offset;
        end
      end
      $display("FAIL [[ name.out_valid ]] is not where the answers are: they have a latency of %0d, the flag one of %0d",
        LATENCY, LATENCY + best_offset);
      stop;
    end else begin
      right_status = 0;
      for (i = 0; i < count; i = i + 1) begin
        if (seen_status[taken_at[i] + LATENCY] === expected[i][STATUS+OUTPUT-1:OUTPUT]) right_status = right_status + 1;
      end
      if (HAS_STATUS && 2 * here > count && right_status == 0) begin
        $display("FAIL [[ name.status ]] is wrong in all of %0d answers and the intensity is not; null in the map of ports leaves it out",
          count);
        stop;
      end
      for (i = 0; i < count; i = i + 1)
        if (!ended) compare(i, seen_intensity[taken_at[i] + LATENCY], seen_status[taken_at[i] + LATENCY]);
    end
  endtask

  task automatic probe;
    if (!rst) begin
      seen_intensity[tick] = intensity;
      seen_status[tick]    = status;
      seen_valid[tick]     = HAS_OUT_VALID && out_valid;
      if (taken) begin
        was_taken[tick] = 1'b1;
        taken_at[sent]  = tick;
        sent = sent + 1;
      end
      tick = tick + 1;
    end
    if (tick == HISTORY && !ended) begin
      judge_assumptions;
      probing = 1'b0;
      start;
    end
  endtask

  // ---- Judge: every answer in its order, and in its cycle where nothing can wait --------------------
  task automatic judge;
    logic due, offered;
    due = under_way > 0 && tick == since[oldest] + LATENCY;
    offered = HAS_OUT_VALID ? out_valid : due;
    if (HAS_OUT_VALID && out_valid !== 1'b0 && out_valid !== 1'b1) begin
      $display("FAIL [[ name.out_valid ]], cycle %0d: is x", cycle);
      stop;
    end else if (IS_TIMED && enabled && HAS_OUT_VALID && out_valid !== due) begin
      $display("FAIL [[ name.out_valid ]], cycle %0d: is %b, expected %b: a request is answered after %0d cycles, without exception",
        cycle, out_valid, due, LATENCY);
      stop;
    end else if (stalled && {status, intensity} !== stalled_answer) begin
      $display("FAIL [[ name.intensity ]], cycle %0d: an answer that waits for [[ name.out_ready ]] must stay as it is", cycle);
      stop;
    end else if (stalled && !offered) begin
      $display("FAIL [[ name.out_valid ]], cycle %0d: an answer that waits for [[ name.out_ready ]] is withdrawn", cycle);
      stop;
    end else if (offered && under_way == 0) begin
      $display("FAIL [[ name.out_valid ]], cycle %0d: an answer to no request", cycle);
      stop;
    end
    stalled = !ended && !IS_TIMED && offered && !out_ready;
    stalled_answer = {status, intensity};
    if (HAS_OUT_READY && !out_ready && under_way > 0) stalls = stalls + 1;
    if (!ended && offered && enabled && (out_ready || !HAS_OUT_READY)) begin
      compare(received % VECTORS, intensity, status);
      if (log != 0 && received < VECTORS) $fwrite(log, "%0d,%h[[ log_format ]]\n", received, intensity[[ log_value ]]);
      received = received + 1;
      oldest = (oldest + 1) % DEEP;
      under_way = under_way - 1;
    end
    if (!ended && idle > 2 * LATENCY + REACH && under_way > 0) begin
      $display("FAIL answers are missing: %0d of %0d requests were answered", received, sent);
      stop;
    end
  endtask

  task automatic step;
    if (enabled && !in_valid && sent < total && !rst && in_ready) bubbles = bubbles + 1;
    if (taken) begin
      since[(oldest + under_way) % DEEP] = tick;
      under_way = under_way + 1;
      if (under_way == DEEP && !ended) begin
        $display("FAIL answers are missing: %0d requests are under way", DEEP);
        stop;
      end
      sent = sent + 1;
    end
    if (enabled) tick = tick + 1;
    if (rst) begin
      // What was under way is lost, and sent again.
      under_way = 0;
      stalled = 1'b0;
      sent = received;
    end
  endtask

  task automatic drive;
    draw;
    if (cycle % 64 == 0) mode = plain || probing ? 3'd0 : cycle < 256 ? 3'(cycle / 64) : random[10:8];
    if (reset_left > 0) reset_left = reset_left - 1;
    else if (HAS_RESET && !plain && !probing && resets < 3 && sent > (resets + 1) * (total / 4)
        && random[31:28] == 0) begin
      reset_left = 2;
      resets = resets + 1;
    end
    rst <= HAS_RESET && reset_left > 0;
    out_ready <= !(HAS_OUT_READY && (mode[0] || mode[2]) && random[0]);
    waits = in_valid && !taken && !rst;
    if (waits) begin
      // A request that was not taken stays.
    end else if (sent < (probing ? PROBE : total) && !(mode[2] ? random[4:1] == 0 : mode[1] && random[1])) begin
      in_valid <= 1'b1;
      {address, x} <= stimulus[sent % VECTORS][ADDRESS+INPUT-1:0];
    end else begin
      // A bubble carries rubbish, which must not show.
      in_valid <= 1'b0;
      {address, x} <= (ADDRESS + INPUT)'({random, ~random, random});
    end
  endtask

  always @(posedge clk) begin
    if (!ended) begin
      enabled = !rst && (!IS_ENABLE || out_ready);
      taken = enabled && in_valid && in_ready === 1'b1;
      if (probing) begin
        probe;
      end else begin
        if (!rst) judge;
        step;
        if (received == total || under_way > 0) idle = idle + 1;
        if (taken) idle = 0;
      end
      drive;
      cycle = cycle + 1;
      // Nothing more may come out.
      if (!probing && received == total && idle > 2 * LATENCY + 4 && !ended) begin
        if (log != 0) $fclose(log);
        $display("%0d cycles, %0d stalls, %0d bubbles, %0d resets, %0d values compared",
          cycle, stalls, bubbles, resets, words_compared);
        if (failures != 0) $display("FAIL %0d values differ; the first: %0s", failures, first_failure);
        else $display("PASS %0d vectors", VECTORS);
        stop;
      end
    end
  end

endmodule
// verilator lint_on BLKSEQ

`default_nettype wire
