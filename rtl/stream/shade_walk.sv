// shade_walk: control of a walk: an item of n steps in, n steps out, one a clock, as long as there are credits.
//
// load_o: an item is taken in this clock; issue_o: a step is made, first_o and last_o frame the item's. A new item is
// taken together with the last step of the old one, so that steps follow each other without a bubble.
//
//   count_i   n >= 1, with the item; a caller must give n = 0 a fault
//   error_i   the item's faults: with any it is dropped and costs one clock, no step
//   credit_i  gives a credit back, for a step 1 clock later; 2^CREDIT_LOG2 are there after reset, a step costs one
//   error_o   sticky faults; error_count_o  dropped items, saturating
//
// No path leads from an input to ready_o, issue_o, first_o or last_o. Latency of a first step: 1 clock behind its item.
// Example: items of 2 and 1 steps in clocks 0 and 1 -> load 0, 2; issue 1 (first), 2 (last), 3 (first, last).
module shade_walk #(
  parameter int COUNT_W     = shade_pkg::COUNT_W,
  parameter int ERROR_W     = shade_pkg::ERROR_W,
  parameter int CREDIT_LOG2 = shade_pkg::FIFO_LOG2
) (
  input  logic               clk_i,
  input  logic               rst_i,
  input  logic               valid_i,
  output logic               ready_o,
  input  logic [COUNT_W-1:0] count_i,
  input  logic [ERROR_W-1:0] error_i,
  input  logic               credit_i,
  output logic               load_o,
  output logic               issue_o,
  output logic               first_o,
  output logic               last_o,
  output logic [ERROR_W-1:0] error_o,
  output logic [       15:0] error_count_o
);
  if (COUNT_W < 1 || ERROR_W < 1 || CREDIT_LOG2 < 1) begin : g_check
    $error("shade_walk: COUNT_W, ERROR_W and CREDIT_LOG2 must be at least 1");
  end

  logic busy_q, some_credit_q;
  logic [COUNT_W-1:0] left_q;  // steps behind the one at hand
  logic [CREDIT_LOG2:0] credit_q, credit_d;

  assign issue_o  = busy_q && some_credit_q;
  assign ready_o  = !busy_q || (issue_o && last_o);
  assign load_o   = valid_i && ready_o;
  assign credit_d = credit_q + (CREDIT_LOG2 + 1)'(credit_i) - (CREDIT_LOG2 + 1)'(issue_o);

  always_ff @(posedge clk_i) begin
    if (load_o) begin
      first_o <= 1'b1;
      last_o  <= count_i == COUNT_W'(1);
      left_q  <= count_i - COUNT_W'(1);
    end else if (issue_o) begin
      first_o <= 1'b0;
      last_o  <= left_q == COUNT_W'(1);
      left_q  <= left_q - COUNT_W'(1);
    end

    credit_q      <= credit_d;
    some_credit_q <= credit_d != '0;
    if (load_o) busy_q <= error_i == '0;
    else if (issue_o && last_o) busy_q <= 1'b0;
    if (load_o) begin
      error_o <= error_o | error_i;
      if (error_i != '0 && !(&error_count_o)) error_count_o <= error_count_o + 16'd1;
    end
    if (rst_i) begin
      busy_q        <= 1'b0;
      credit_q      <= (CREDIT_LOG2 + 1)'(1 << CREDIT_LOG2);
      some_credit_q <= 1'b1;
      error_o       <= '0;
      error_count_o <= '0;
    end
  end
endmodule
