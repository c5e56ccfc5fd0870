// Self-checking testbench of the configuration "[[ configuration ]]".
// Made by: [[ command ]]
//
// Sends every vector of stimulus.mem through the DUT and judges, in every cycle,
//   - the handshake: in_ready_o and out_valid_o against a mirror of the rules, and so latency and order;
//   - the results against expected.mem, also while they are stalled;
<%- if white_box %>
//   - every register of every rank against stages.mem, so that the first stage that departs is named;
//     a rank that does not load must hold, whether it is stalled or empty.
<%- endif %>
// Stalls, bubbles and resets in mid-flight come from the seed; what a reset loses is sent again, and a
// small bundle is sent several times. A request that is not taken stays as it is until it is. X is
// never right (`!==`). Ends with one line, "PASS <count> vectors" or "FAIL ...".
//
// Options:
//   +seed=N           another order of stalls, bubbles and resets (1)
//   +plain            no stalls, bubbles or resets
//   +expected=FILE    other answers (expected.mem); negative_control.mem must FAIL
//   +waves=FILE       dump waves
//   +log=FILE         write every answer as CSV for `blysk check`, and do not stop at the first failure
<%- if white_box %>
//   +registers=N      no vectors: N random cycles, every register printed for `blysk check --registers`;
//                     any pattern of requests, also such as are withdrawn before they are taken
<%- endif %>
`timescale 1ns / 1ps
`default_nettype none

// One process judges and drives, and its tasks go on with what those before them have set in the same cycle: blocking
// assignments to its own state, others to what the DUT reads.
// verilator lint_off BLKSEQ
module blysk_tb;

  localparam int VECTORS  = [[ vectors ]];
  localparam int RANKS    = [[ ranks ]];
  localparam int DEPTH    = [[ depth ]];
  localparam int ADDRESS  = [[ address.width ]];
  localparam int INPUT    = [[ x.width ]];
  localparam int OUTPUT   = [[ intensity.width ]];
  localparam int STATUS   = [[ status_width ]];
  localparam int STAGES   = [[ stage_width ]];
  localparam int WORD     = [[ rom_width ]];
  // Requests of a run at the least: enough for blocks with stalls, with bubbles, with both, and resets.
  localparam int REQUESTS = 2048;
  // A word that no file wrote keeps its mark, which lies above the bits of the word.
  localparam int MARK     = 4;

  // ---- Vectors ------------------------------------------------------------------------------------
  logic [MARK+ADDRESS+INPUT-1:0] stimulus [0:VECTORS-1];
  logic [MARK+STATUS+OUTPUT-1:0] expected [0:VECTORS-1];
<%- if white_box %>
  logic [MARK+STAGES-1:0]        stages   [0:VECTORS-1];
<%- endif %>
  logic [MARK+63:0]              exponents[0:DEPTH-1];
  // The DUT reads it too; here only to see that all of it is there.
  logic [MARK+WORD-1:0]          rom      [0:DEPTH-1];

  // ---- Options --------------------------------------------------------------------------------------
  string       expected_file, waves_file, log_file;
  integer      seed, log, trace_cycles, total, i;
  logic        plain;
  // The state of the random numbers.
  logic [31:0] random;

  // ---- The mirror: which vector each rank holds -----------------------------------------------------
  logic [RANKS-1:0] held, advance;
  // Ranks that the last edge loaded, and those that any edge has.
  logic [RANKS-1:0] loads, loaded;
  integer           vector_of [0:RANKS-1];
<%- if rules.slice.is_some() %>
  // The register slice: the vectors in its head and its spare entry, and whether an edge has loaded them.
  logic             head_held, spare_held, head_loaded, spare_loaded, comes, moves, follows;
  integer           head_of, spare_of;
<%- endif %>
  integer           sent, received, cycle, stalls, bubbles, resets, reset_left, idle, rank;
  integer           words_compared, failures;
  logic [2:0]       mode;
  logic             expect_ready, waits, ended;
  string            first_failure;
<%- if white_box %>
  // What each vector showed, for the log.
  logic [STAGES-1:0] seen [0:VECTORS-1];
<%- endif %>

<% include "tb_clock.sv" %>

  [[ dut ]] dut (
    .clk_i(clk), .[[ rules.reset_port ]]([[ rules.reset ]]),
    .in_valid_i(in_valid), .in_ready_o(in_ready), .address_i(address), .x_i(x),
    .out_valid_o(out_valid), .out_ready_i(out_ready), .intensity_o(intensity), .status_o(status)
  );

  // ---- Begin, end, and the files --------------------------------------------------------------------
  // The rest of the cycle must say nothing more.
  task automatic stop;
    ended = 1'b1;
  endtask

<% include "tb_complete.sv" %>

  initial begin
    rst = 1'b1; in_valid = 1'b0; address = '0; x = '0; out_ready = 1'b0;
    held = '0; loads = '0; loaded = '0; waits = 1'b0;
<%- if rules.slice.is_some() %>
    {head_held, spare_held, head_loaded, spare_loaded} = '0; head_of = 0; spare_of = 0;
<%- endif %>
    sent = 0; received = 0; cycle = 0; stalls = 0; bubbles = 0; resets = 0; idle = 0; mode = '0;
    words_compared = 0; failures = 0; ended = 1'b0;
    reset_left = 2;
    if (!$value$plusargs("seed=%d", seed)) seed = 1;
    if (!$value$plusargs("expected=%s", expected_file)) expected_file = "expected.mem";
    if (!$value$plusargs("registers=%d", trace_cycles)) trace_cycles = 0;
    plain = $test$plusargs("plain") != 0;
    random = seed * 32'h9e3779b9 + 32'h7f4a7c15;
    if (random == 0) random = 1;
    for (i = 0; i < VECTORS; i = i + 1) begin
      stimulus[i] = '1;
      expected[i] = '1;
<%- if white_box %>
      stages[i]   = '1;
<%- endif %>
    end
    for (i = 0; i < DEPTH; i = i + 1) begin
      exponents[i] = '1;
      rom[i]       = '1;
    end
    $readmemh("stimulus.mem", stimulus, 0, VECTORS - 1);
    $readmemh(expected_file, expected, 0, VECTORS - 1);
<%- if white_box %>
    $readmemh("stages.mem", stages, 0, VECTORS - 1);
<%- endif %>
    $readmemh("exponents.mem", exponents, 0, DEPTH - 1);
    $readmemh("rom.mem", rom, 0, DEPTH - 1);
    for (i = 0; i < VECTORS; i = i + 1) begin
      complete(stimulus[i][MARK+ADDRESS+INPUT-1], ^stimulus[i], "stimulus.mem", i);
      complete(expected[i][MARK+STATUS+OUTPUT-1], ^expected[i], expected_file, i);
<%- if white_box %>
      complete(stages[i][MARK+STAGES-1], ^stages[i], "stages.mem", i);
<%- endif %>
    end
    for (i = 0; i < DEPTH; i = i + 1) begin
      complete(exponents[i][MARK+63], ^exponents[i], "exponents.mem", i);
      complete(rom[i][MARK+WORD-1], ^rom[i], "rom.mem", i);
    end
    total = VECTORS;
    while (!plain && total < REQUESTS && VECTORS > 0) total = total + VECTORS;
    if (VECTORS == 0 && !ended) begin
      $display("FAIL no vectors: nothing would be checked");
      stop;
    end
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
      $fwrite(log, "index,intensity,status[[ log_columns ]]\n");
    end
  end

  // ---- Random numbers: xorshift, the same in every simulator ----------------------------------------
<% include "tb_draw.sv" %>

  // ---- Failures -------------------------------------------------------------------------------------
<% include "tb_value.sv" %>

  task automatic fail(input integer index, input logic load, input string where,
                      input logic [63:0] got, input logic [63:0] wanted, input integer width,
                      input integer is_signed, input integer fraction);
    logic [ADDRESS-1:0] fail_address;
    logic [INPUT-1:0]   fail_x;
    real                exponent;
    failures = failures + 1;
    if (failures == 1) begin
      {fail_address, fail_x} = stimulus[index][ADDRESS+INPUT-1:0];
      exponent = 0.0;
      if (32'(fail_address) < DEPTH) exponent = $bitstoreal(exponents[32'(fail_address)][63:0]);
      first_failure = $sformatf("vector %0d: address %0d (n = %0g), x = %0d'h%h (%0.9g), cycle %0d: %0s is %0d'h%0h (%0.9g), expected %0d'h%0h (%0.9g)%0s",
        index, fail_address, exponent, INPUT, fail_x,
        value(64'(fail_x), INPUT, [[ x.signed ]], [[ x.fraction ]]), cycle, where,
        width, got, value(got, width, is_signed, fraction),
        width, wanted, value(wanted, width, is_signed, fraction),
        load ? "" : "; no load in this cycle, it must hold: its enable, or the handshake");
    end
    if (log == 0) begin
      $display("FAIL %0s", first_failure);
      stop;
    end
  endtask

  task automatic fail_port(input string port, input logic got, input logic wanted, input string why);
    failures = failures + 1;
    $display("FAIL handshake, cycle %0d: %0s is %b, expected %b: %0s", cycle, port, got, wanted, why);
    stop;
  endtask
<%- if white_box %>

  // Every register of every rank that was ever loaded; the first that departs is the fault's stage.
  task automatic compare_registers;
    logic [STAGES-1:0] word;
<%- for rank in white_box_ranks %>
    if (loaded[ [[ rank.index ]] ] && !ended) begin
      word = stages[vector_of[ [[ rank.index ]] ]][STAGES-1:0];
<%- for register in rank.registers %>
      if ([[ register.path ]] !== word[ [[ register.msb ]]:[[ register.lsb ]] ] && !ended)
        fail(vector_of[ [[ rank.index ]] ], loads[ [[ rank.index ]] ], "[[ register.name ]]", 64'([[ register.path ]]),
          64'(word[ [[ register.msb ]]:[[ register.lsb ]] ]), [[ register.width ]], [[ register.signed ]], [[ register.fraction ]]);
<%- if register.computed %>
      if (held[ [[ rank.index ]] ]) seen[vector_of[ [[ rank.index ]] ]][ [[ register.msb ]]:[[ register.lsb ]] ] = [[ register.path ]];
<%- endif %>
<%- endfor %>
      words_compared = words_compared + [[ rank.count ]];
    end
<%- endfor %>
<%- if rules.slice.is_some() %>
    if (head_loaded && !ended) begin
      if (dut.[[ rules.path ]].head_q !== [[ rules.word("head_of") ]] && !ended)
        fail(head_of, 1'b1, "[[ rules.name ]].head", 64'(dut.[[ rules.path ]].head_q), 64'([[ rules.word("head_of") ]]), [[ rules.width ]], 0, 0);
      words_compared = words_compared + 1;
    end
    if (spare_loaded && !ended) begin
      if (dut.[[ rules.path ]].spare_q !== [[ rules.word("spare_of") ]] && !ended)
        fail(spare_of, 1'b1, "[[ rules.name ]].spare", 64'(dut.[[ rules.path ]].spare_q), 64'([[ rules.word("spare_of") ]]), [[ rules.width ]], 0, 0);
      words_compared = words_compared + 1;
    end
<%- endif %>
  endtask
<%- endif %>

  task automatic compare_result;
    integer index;
    index = [[ rules.shown_vector ]];
    if (intensity !== expected[index][OUTPUT-1:0] && !ended)
      fail(index, [[ rules.shown_loads ]], "[[ last ]].intensity", 64'(intensity), 64'(expected[index][OUTPUT-1:0]), OUTPUT, 0, [[ intensity.fraction ]]);
    if (status !== expected[index][STATUS+OUTPUT-1:OUTPUT] && !ended)
      fail(index, [[ rules.shown_loads ]], "[[ last ]].status", 64'(status), 64'(expected[index][STATUS+OUTPUT-1:OUTPUT]), STATUS, 0, 0);
    words_compared = words_compared + 2;
    if (out_ready && !rst) begin
      if (index != received % VECTORS && !ended) begin
        $display("FAIL order: a mistake of the mirror");
        stop;
      end
      if (log != 0 && received < VECTORS) $fwrite(log, "%0d,%h,%h[[ log_format ]]\n", index, intensity, status[[ log_values ]]);
      received = received + 1;
    end
  endtask

  task automatic compare_handshake;
<%- if rules.asynchronous %>
    // The reset is there already.
    if (rst) begin
      held = '0;
<%- if rules.slice.is_some() %>
      {head_held, spare_held} = '0;
<%- endif %>
    end
<%- endif %>
<%- match rules.handshake %>
<%- when Handshake::ValidReady %>
    advance[RANKS-1] = !held[RANKS-1] || [[ rules.taken ]];
    for (rank = RANKS - 2; rank >= 0; rank = rank - 1) advance[rank] = !held[rank] || advance[rank+1];
<%- when Handshake::Enable %>
    advance = {RANKS{out_ready}};
<%- when Handshake::None %>
    advance = '1;
<%- endmatch %>
    expect_ready = [[ rules.ready ]];
    if (cycle > 0) begin
      if (in_ready !== expect_ready && !ended)
        fail_port("in_ready_o", in_ready, expect_ready, "[[ rules.rule ]]");
      if (out_valid !== [[ rules.shown ]] && !ended)
        fail_port("out_valid_o", out_valid, [[ rules.shown ]], "the latency is [[ latency ]] cycles, and more where it is stalled");
<%- if white_box %>
      for (rank = 0; rank < RANKS; rank = rank + 1) begin
        if (dut.handshake.valid_q[rank] !== held[rank] && !ended)
          fail_port($sformatf("the valid flag of rank %0d", rank), dut.handshake.valid_q[rank], held[rank],
            "what a rank holds comes from the rank before it, when it advances");
      end
<%- if rules.slice.is_some() %>
      if (dut.[[ rules.path ]].valid_q !== {spare_held, head_held} && !ended)
        fail_port("a valid flag of the [[ rules.name ]]", ^dut.[[ rules.path ]].valid_q, spare_held ^ head_held,
          "its head is full when one waits, its spare entry when two do");
<%- endif %>
<%- endif %>
    end
  endtask

  // What the edge does. A rank loads when it advances and is offered something; in reset the ranks from 1 on
  // do so too, and only their valid flags are cleared.
  task automatic step;
    loads = '0;
    waits = in_valid && [[ rules.refuses ]] && !rst;
    if ([[ rules.shown ]] && !out_ready && !rst) stalls = stalls + 1;
    if (expect_ready && !in_valid && sent < total) bubbles = bubbles + 1;
<%- if rules.slice == Some(ReadySlice::Output) %>
    comes = held[RANKS-1] && !spare_held;
    moves = out_ready || !head_held;
    follows = spare_held || comes;
    if (moves && follows) begin
      head_of = spare_held ? spare_of : vector_of[RANKS-1];
      head_loaded = 1'b1;
    end
    if (!moves && comes) begin
      spare_of = vector_of[RANKS-1];
      spare_loaded = 1'b1;
    end
    head_held = !moves || follows;
    spare_held = !moves && follows;
<%- endif %>
    for (rank = RANKS - 1; rank > 0; rank = rank - 1) begin
      if (advance[rank]) begin
        held[rank]  = held[rank-1];
        loads[rank] = held[rank-1];
        if (held[rank-1]) vector_of[rank] = vector_of[rank-1];
      end
    end
<%- if rules.slice == Some(ReadySlice::Input) %>
    if (advance[0]) begin
      held[0]  = head_held && !rst;
      loads[0] = head_held && !rst;
      if (head_held && !rst) vector_of[0] = head_of;
    end
    comes = in_valid && !rst && !spare_held;
    moves = advance[0] || !head_held;
    follows = spare_held || comes;
    if (moves && follows) begin
      head_of = spare_held ? spare_of : sent % VECTORS;
      head_loaded = 1'b1;
    end
    if (!moves && comes) begin
      spare_of = sent % VECTORS;
      spare_loaded = 1'b1;
    end
    if (comes) sent = sent + 1;
    head_held = !moves || follows;
    spare_held = !moves && follows;
<%- else %>
    if (advance[0]) begin
      held[0]  = in_valid && !rst;
      loads[0] = in_valid && !rst;
      if (in_valid && !rst) begin
        vector_of[0] = sent % VECTORS;
        sent = sent + 1;
      end
    end
<%- endif %>
    loaded = loaded | loads;
    if (rst) begin
      held = '0;
<%- if rules.slice.is_some() %>
      {head_held, spare_held} = '0;
<%- endif %>
      // What was in flight is lost, and sent again.
      sent = received;
    end
  endtask

  // What the next cycle is given: blocks of 64 cycles without trouble, with stalls, with bubbles, with
  // both, and then any of these, or stalls with few bubbles: a bubble on its way through ranks that are
  // all full shows an advance that is worked out from the wrong ranks.
  task automatic drive;
    draw;
    if (cycle % 64 == 0) mode = plain ? 3'd0 : cycle < 256 ? 3'(cycle / 64) : random[10:8];
    if (reset_left > 0) reset_left = reset_left - 1;
    else if (!plain && resets < 3 && sent > (resets + 1) * (total / 4) && random[31:28] == 0) begin
      reset_left = 2;
      resets = resets + 1;
    end
    rst <= reset_left > 0;
<%- if rules.handshake == Handshake::None %>
    out_ready <= 1'b1;
<%- else %>
    out_ready <= !((mode[0] || mode[2]) && random[0]);
<%- endif %>
    if (waits) begin
      // A request that was not taken stays.
    end else if (sent < total && !(mode[2] ? random[4:1] == 0 : mode[1] && random[1])) begin
      in_valid <= 1'b1;
      {address, x} <= stimulus[sent % VECTORS][ADDRESS+INPUT-1:0];
    end else begin
      // A bubble carries rubbish, which must not show.
      in_valid <= 1'b0;
      {address, x} <= (ADDRESS + INPUT)'({random, ~random, random});
    end
  endtask

  always @(posedge clk) begin
    if (!ended && trace_cycles == 0) begin
      compare_handshake;
<%- if white_box %>
      if (!ended) compare_registers;
<%- endif %>
      if ([[ rules.shown ]] && !ended) compare_result;
      step;
      drive;
      cycle = cycle + 1;
      if (received == total) idle = idle + 1;
      // Nothing more may come out.
      if (idle > 2 * RANKS && !ended) begin
        if (log != 0) $fclose(log);
        $display("%0d cycles, %0d stalls, %0d bubbles, %0d resets, %0d values compared",
          cycle, stalls, bubbles, resets, words_compared);
        if (failures != 0) $display("FAIL %0d values differ; the first: %0s", failures, first_failure);
        else if (!plain && (<% if rules.handshake != Handshake::None %>stalls == 0 || <% endif %>bubbles == 0 || resets == 0))
          $display("FAIL a run without stalls, bubbles or resets shows little; use another +seed");
        else $display("PASS %0d vectors", VECTORS);
        stop;
      end
    end
  end
<%- if white_box %>

  // ---- Random cycles, every register printed ----------------------------------------------------------
  // One line a cycle, what the edge that ends it sees: the ports, then each rank's valid flag and
  // registers, in the order of the columns of `blysk simulate --trace`.
  task automatic drive_anything;
    integer pick;
    draw;
    if (cycle % 64 == 0) mode = {1'b0, random[9:8]};
    rst <= cycle < 2 || random[31:24] == 0;
    out_ready <= !(mode[0] && random[0]);
    in_valid <= !(mode[1] && random[1]);
    draw;
    pick = 32'(random[3:0]);
    draw;
    address <= pick[0] ? ADDRESS'(random % DEPTH) : ADDRESS'(random);
    if (DEPTH > 1 && pick[3:1] != 0) address <= ADDRESS'(32'(random[30:8]) % DEPTH);
    draw;
    if (pick == 0) x <= INPUT'({random, ~random});
    else if (pick < 10) x <= INPUT'(64'd1 << [[ x.fraction ]]) - INPUT'({random, random} >> (64 - [[ x.fraction ]] + pick));
    else if (pick < 14) x <= INPUT'({random, ~random} >> (64 - [[ x.fraction ]]));
    else {address, x} <= stimulus[random % VECTORS][ADDRESS+INPUT-1:0];
  endtask

  always @(posedge clk) begin
    if (!ended && trace_cycles > 0) begin
      $display("[[ trace_format ]]",
        rst, in_valid, in_ready, address, x, out_valid, out_ready[[ trace_values ]]);
      drive_anything;
      cycle = cycle + 1;
      if (cycle == trace_cycles) begin
        $display("R-END %0d", cycle);
        stop;
      end
    end
  end
<%- endif %>

endmodule
// verilator lint_on BLKSEQ

`default_nettype wire
