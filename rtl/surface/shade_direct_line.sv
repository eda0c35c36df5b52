// SPDX-License-Identifier: Apache-2.0
// shade_direct_line: steps a triangle's scalars from run to run by additions and gives each run a start.
//
//   a line down:   a += a_l; h += h_l; p_c += p_cl; p_l += 2 p_ll; p += p_l
//   to the right:  a += a_c; h += h_c; p_l += p_cl; p_c += 2 p_cc; p += p_c       to the left: the same subtracted, p last
//
// valid_i, moves_i: the next run, see shade_direct_moves; full_i, coefficients_i: the next triangle, taken by next_o, a
// clock behind the start of the last run of the one before, or later. start_valid_o: a start, two clocks behind its last move, for 2^LOG2
// places; credit_i: one of them is free again. dropped_o: a run that is not good was passed over.
// A run costs a clock, and as many as it needs moves; to the left one more. No path leads from an input to an output.
// Example: a = 0, a_c = 2, a_l = 3; runs 0, then 1 line and 1 column farther -> starts with a = 0, 5.
module shade_direct_line #(
  parameter int LOG2 = shade_pkg::DIRECT_STARTS_LOG2
) (
  input  logic                     clk_i,
  input  logic                     rst_i,
  input  logic                     valid_i,
  output logic                     ready_o,
  input  shade_pkg::moves_t        moves_i,
  input  logic                     full_i,
  output logic                     next_o,
  input  shade_pkg::coefficients_t coefficients_i,
  output logic                     start_valid_o,
  output shade_pkg::start_t        start_o,
  input  logic                     credit_i,
  output logic                     dropped_o
);
  if (LOG2 < 1) begin : g_check
    $error("shade_direct_line: LOG2 must be at least 1");
  end
  localparam int COUNT_W = shade_pkg::COUNT_W;

  // ---- which move is next -------------------------------------------------------------------------------------------
  typedef struct packed {
    logic start;
    logic next;
    logic down;
    logic side;
    logic left;
    logic behind;  // p follows a step to the left, a clock later
  } move_t;
  move_t move, move_q;
  shade_pkg::moves_t run_q;
  logic busy_q, loaded_q, behind_q, lines_q, columns_q, some_credit_q, done, end_of_triangle;
  logic [LOG2:0] credit_q, credit_d;
  always_comb begin
    move = '0;
    done = 1'b0;
    if (busy_q && loaded_q) begin
      if (lines_q) move.down = 1'b1;
      else if (columns_q) begin
        move.side   = 1'b1;
        move.left   = run_q.columns < 0;
        move.behind = behind_q;
      end else if (behind_q) move.behind = 1'b1;
      else if (some_credit_q || !run_q.good) begin
        done       = 1'b1;
        move.start = run_q.good;
        move.down  = run_q.good;
      end
    end
    end_of_triangle = done && run_q.last;
    move.next       = full_i && !move_q.next && (end_of_triangle || !loaded_q);
    if (move.next) move.down = 1'b0;
  end
  logic signed [COUNT_W-1:0] nearer;  // columns, less the one at hand
  assign nearer   = run_q.columns + {{(COUNT_W - 1) {run_q.columns >= 0}}, 1'b1};
  assign next_o   = move_q.next;
  assign ready_o  = !busy_q || done;
  assign credit_d = credit_q + (LOG2 + 1)'(credit_i) - (LOG2 + 1)'(move.start);
  always_ff @(posedge clk_i) begin
    if (valid_i && ready_o) begin
      run_q     <= moves_i;
      lines_q   <= moves_i.lines != '0;
      columns_q <= moves_i.columns != '0;
    end else if (busy_q && loaded_q) begin
      if (lines_q) begin
        run_q.lines <= run_q.lines - COUNT_W'(1);
        lines_q     <= run_q.lines != COUNT_W'(1);
      end else if (columns_q) begin
        run_q.columns <= nearer;
        columns_q     <= nearer != '0;
      end
    end
    behind_q <= move.side && move.left;
    move_q   <= move;
    dropped_o <= done && !run_q.good;
    if (ready_o) busy_q <= valid_i;
    if (move.next) loaded_q <= 1'b1;
    else if (end_of_triangle) loaded_q <= 1'b0;
    credit_q      <= credit_d;
    some_credit_q <= credit_d != '0;
    if (rst_i) begin
      busy_q        <= 1'b0;
      loaded_q      <= 1'b0;
      behind_q      <= 1'b0;
      dropped_o     <= 1'b0;
      move_q        <= '0;
      credit_q      <= (LOG2 + 1)'(1 << LOG2);
      some_credit_q <= 1'b1;
    end
  end

  // ---- the scalars, and what they grow by -----------------------------------------------------------------------------
  localparam int A_W = shade_pkg::DIRECT_A_W;
  localparam int H_W = shade_pkg::DIRECT_H_W;
  localparam int P_W = shade_pkg::DIRECT_P_W;
  shade_pkg::coefficients_t by_q;
  logic [A_W-1:0] a_q, a_by;
  logic [H_W-1:0] h_q, h_by;
  logic [P_W-1:0] p_q, column_q, line_q, p_by, column_by, line_by;
  logic minus;
  assign minus     = move_q.left;
  assign a_by      = (move_q.down ? by_q.a_line : by_q.a_column) ^ {A_W{minus}};
  assign h_by      = (move_q.down ? by_q.h_line : by_q.h_column) ^ {H_W{minus}};
  assign column_by = (move_q.down ? by_q.p_both : {by_q.p_columns[P_W-2:0], 1'b0}) ^ {P_W{minus}};
  assign line_by   = (move_q.down ? {by_q.p_lines[P_W-2:0], 1'b0} : by_q.p_both) ^ {P_W{minus}};
  assign p_by      = (move_q.down ? line_q : column_q) ^ {P_W{move_q.behind}};
  logic [A_W-1:0] a_sum;
  logic [H_W-1:0] h_sum;
  logic [P_W-1:0] p_sum, column_sum, line_sum;
  logic [4:0] low;
  // the carry in is one more bit at the bottom
  assign {a_sum, low[0]}      = {a_q, 1'b1} + {a_by, minus};
  assign {h_sum, low[1]}      = {h_q, 1'b1} + {h_by, minus};
  assign {column_sum, low[2]} = {column_q, 1'b1} + {column_by, minus};
  assign {line_sum, low[3]}   = {line_q, 1'b1} + {line_by, minus};
  assign {p_sum, low[4]}      = {p_q, 1'b1} + {p_by, move_q.behind};
  logic step_p;
  assign step_p = move_q.down || move_q.behind || (move_q.side && !move_q.left);
  always_ff @(posedge clk_i) begin
    if (move_q.next) begin
      by_q     <= coefficients_i;
      a_q      <= coefficients_i.a;
      h_q      <= coefficients_i.h;
      p_q      <= coefficients_i.p;
      column_q <= coefficients_i.p_column;
      line_q   <= coefficients_i.p_line;
    end else begin
      if (move_q.down || move_q.side) begin
        a_q      <= a_sum;
        h_q      <= h_sum;
        column_q <= column_sum;
        line_q   <= line_sum;
      end
      if (step_p) p_q <= p_sum;
    end
  end

  // ---- starts -----------------------------------------------------------------------------------------------------------
  logic [COUNT_W-1:0] count_q;
  logic [shade_pkg::TAG_W-1:0] tag_q;
  always_ff @(posedge clk_i) begin
    count_q <= run_q.count;
    tag_q   <= run_q.tag;
  end
  assign start_valid_o = move_q.start;
  assign start_o = {tag_q, count_q, by_q.p_columns, by_q.h_column, by_q.a_column, column_q, p_q, h_q, a_q};

  logic unused_bits;
  assign unused_bits = &{1'b0, low, by_q, run_q};
endmodule
