  // `known` is the exclusive or of the word's bits, which is x where one of them is.
  task automatic complete(input logic unwritten, input logic known, input string name, input integer index);
    if (ended) begin
    end else if (known === 1'bx) begin
      $display("FAIL %0s: word %0d has an x or z in it", name, index);
      stop;
    end else if (unwritten !== 1'b0) begin
      $display("FAIL %0s: word %0d is missing; the file is not there or is too short", name, index);
      stop;
    end
  endtask
