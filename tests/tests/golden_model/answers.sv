// What the functions of blysk_dpi_pkg answer, without a DUT:
//
//   answers +configuration=FILE +requests=FILE +cycles=FILE +answers=FILE +shown=FILE
//
// Requests are lines of address and x, cycles of reset, in_valid, address, x and out_ready: words in hex. Answers are
// lines of intensity and status; shown are in_ready, out_valid, intensity and status.
`timescale 1ns / 1ps
`default_nettype none

module answers;

  import blysk_dpi_pkg::*;

  string           path;
  int              questions, replies, count;
  int unsigned     reset, in_valid, address, out_ready;
  longint unsigned x, intensity;
  byte unsigned    in_ready, out_valid, status;
  chandle          model, pipeline;

  task automatic need(input bit good, input string what);
    if (!good) begin
      $display("answers: %0s: %0s", what, blysk_last_error());
      $fatal(1);
    end
  endtask

  initial begin
    need($value$plusargs("configuration=%s", path) != 0, "+configuration");
    need(blysk_model_from_file(ABI_VERSION, path, model) == CODE_OK, path);

    need($value$plusargs("requests=%s", path) != 0, "+requests");
    questions = $fopen(path, "r");
    need($value$plusargs("answers=%s", path) != 0, "+answers");
    replies = $fopen(path, "w");
    count   = 0;
    while ($fscanf(questions, "%h %h\n", address, x) == 2) begin
      need(blysk_dpi_answer(model, address, x, intensity, status) == CODE_OK, "answer");
      $fwrite(replies, "%0h %0h\n", intensity, status);
      count = count + 1;
    end
    $fclose(questions);
    $fclose(replies);
    $display("%0d requests", count);

    need($value$plusargs("cycles=%s", path) != 0, "+cycles");
    questions = $fopen(path, "r");
    need($value$plusargs("shown=%s", path) != 0, "+shown");
    replies = $fopen(path, "w");
    count   = 0;
    need(blysk_pipeline_new(model, pipeline) == CODE_OK, "pipeline");
    while ($fscanf(questions, "%h %h %h %h %h\n", reset, in_valid, address, x, out_ready) == 5) begin
      need(blysk_dpi_tick(pipeline, 8'(reset), 8'(in_valid), address, x, 8'(out_ready),
                          in_ready, out_valid, intensity, status) == CODE_OK, "tick");
      $fwrite(replies, "%0h %0h %0h %0h\n", in_ready, out_valid, intensity, status);
      count = count + 1;
    end
    $fclose(questions);
    $fclose(replies);
    $display("%0d cycles", count);

    blysk_pipeline_free(pipeline);
    blysk_model_free(model);
    $finish(0);
  end

endmodule

`default_nettype wire
