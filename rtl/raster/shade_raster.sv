// SPDX-License-Identifier: Apache-2.0
// shade_raster: the runs of a triangle, line by line downwards, by walking along its edges.
//
// edge_i: three edges of a triangle as shade_edges gives them, the two from the top vertex first, with the remainder r of
// the first line. On every line an edge has the column c and a remainder e >= 0, less than dy: of an edge to the right
// e = r = -256 (x - centre) dy in all, of one to the left its mirror image e = -1 - r, so that both move alike:
//
//   next line    e = e - |dx|
//   settle       e < 0: e = e + dy, c = c + 1, to the left c - 1;   a column a clock, both edges at once
//
// A run goes from the left edge's c to the one before the right edge's, inside of columns_i and lines_i; so two triangles
// with a common edge have each of its pixels once. run_o: {none, last, count, line, column}; last with the last run of a
// triangle; none stands for a triangle without a run. No pixel is tested.
// Exact for vertices up to 32768 pixels away. Clocks: 4 a triangle, 1 a line, 1 a column that an edge moves aside.
// Example: vertices (128, 128), (2688, 128), (128, 2688) -> lines 0 .. 9, counts 10 .. 1.
// Source: Bresenham's way along a line, Algorithm for computer control of a digital plotter (1965), with exact remainders.
module shade_raster #(
  parameter int CREDIT_LOG2 = 4
) (
  input  logic                             clk_i,
  input  logic                             rst_i,
  input  logic [shade_pkg::COUNT_W-1:0]    columns_i,
  input  logic [shade_pkg::COUNT_W-1:0]    lines_i,
  input  logic                             edge_valid_i,
  output logic                             edge_ready_o,
  input  shade_pkg::edge_t                 edge_i,
  output logic                             valid_o,
  output shade_pkg::walked_t               run_o,
  input  logic                             credit_i
);
  if (CREDIT_LOG2 < 3) begin : g_check
    $error("shade_raster: CREDIT_LOG2 must be at least 3");
  end

  localparam int W = shade_pkg::COORDINATE_W;
  localparam int L_W = shade_pkg::LINE_W;
  localparam int E_W = shade_pkg::REST_W;
  localparam int P_W = shade_pkg::PLACE_W;
  localparam int C_W = shade_pkg::COUNT_W;

  // ---- control: two edges, then lines; when one edge ends, the third one takes its place -----------------------------------
  typedef enum logic [1:0] {FIRST, SECOND, WALK, THIRD} state_e;
  state_e state_q;
  logic third_q, some_credit_q, walk, emit, finish, below, below_q;
  logic [1:0] over, calm, load;  // left, right
  logic [L_W-1:0] y_q;
  assign walk         = state_q == WALK;
  assign below        = $signed(y_q) >= $signed(L_W'(lines_i));
  assign emit         = walk && over == 2'b00 && calm == 2'b11 && !below_q && some_credit_q;
  assign finish       = walk && third_q && (over == 2'b11 || below_q) && some_credit_q;
  assign edge_ready_o = state_q != WALK;
  assign load         = !edge_valid_i || state_q == WALK ? 2'b00 : state_q == THIRD ? over : {edge_i.right, !edge_i.right};
  always_ff @(posedge clk_i) begin
    case (state_q)
      FIRST: begin
        third_q <= 1'b0;
        y_q     <= edge_i.line;
        if (edge_valid_i) state_q <= SECOND;
      end
      SECOND: if (edge_valid_i) state_q <= WALK;
      WALK: begin
        if (emit) y_q <= y_q + L_W'(1);
        if (finish) state_q <= FIRST;
        else if ((over != 2'b00 || below_q) && !third_q) state_q <= THIRD;
      end
      default: begin
        third_q <= 1'b1;
        if (edge_valid_i) state_q <= WALK;
      end
    endcase
    if (rst_i) state_q <= FIRST;
  end

  // ---- two edges ------------------------------------------------------------------------------------------------------------
  logic mirror;
  logic [1:0][L_W-1:0] c;
  assign mirror = edge_i.dx[W];
  for (genvar i = 0; i < 2; i++) begin : g_side
    logic signed [E_W-1:0] e_q, sum;
    logic signed [W:0] dx_q;
    logic [W-1:0] dy_q;
    logic [L_W-1:0] c_q, c_base, c_step, left_q;  // left: lines behind this one, -1: none, nor this one
    assign sum     = e_q + (emit ? {1'b1, dx_q ^ {(W + 1) {!dx_q[W]}}} : E_W'(dy_q)) + E_W'(emit && !dx_q[W]);
    assign c_base  = load[i] ? edge_i.column : c_q;
    assign c_step  = load[i] ? {L_W{!mirror}} : dx_q[W] ? '1 : L_W'(1);
    assign calm[i] = !e_q[E_W-1];
    assign over[i] = left_q[L_W-1];
    assign c[i]    = c_q;
    always_ff @(posedge clk_i) begin
      if (load[i]) begin
        dx_q <= edge_i.dx;
        dy_q <= edge_i.dy;
      end
      if (load[i]) e_q <= edge_i.rest ^ {E_W{mirror}};
      else if (emit || (walk && !calm[i])) e_q <= sum;
      if (load[i] || (walk && !calm[i])) c_q <= c_base + c_step;
      if (load[i] || emit) left_q <= (load[i] ? edge_i.lines : left_q) - L_W'(1);
    end
  end

  // ---- the run inside of the frame -------------------------------------------------------------------------------------------
  logic emit_q1, end_q1, emit_q2, end_q2, inside_q1, inside_q2, some_q2;
  logic [1:0][L_W-1:0] c_q1;
  logic [P_W-1:0] y_q1, y_q2, from_q2;
  logic [L_W-1:0] from, to;
  logic [L_W:0] count_q2;  // with a sign
  assign from    = c_q1[0][L_W-1] ? '0 : c_q1[0];
  assign to      = $signed(c_q1[1]) < $signed(L_W'(columns_i)) ? c_q1[1] : L_W'(columns_i);
  assign some_q2 = emit_q2 && inside_q2 && !count_q2[L_W] && count_q2 != '0;
  always_ff @(posedge clk_i) begin
    c_q1      <= c;
    y_q1      <= y_q[P_W-1:0];
    inside_q1 <= !y_q[L_W-1] && !below;
    inside_q2 <= inside_q1;
    below_q   <= below;  // a clock late: one line more is walked, outside of the frame
    emit_q1   <= emit && !rst_i;
    end_q1    <= finish && !rst_i;
    emit_q2   <= emit_q1 && !rst_i;
    end_q2    <= end_q1 && !rst_i;
    y_q2      <= y_q1;
    from_q2   <= from[P_W-1:0];
    count_q2  <= {to[L_W-1], to} - {1'b0, from};
  end

  // ---- a run waits for the next one, or for the end ---------------------------------------------------------------------------
  logic held_q, slot_q2;
  assign slot_q2 = emit_q2 || end_q2;
  logic [P_W+P_W+C_W-1:0] held;
  always_ff @(posedge clk_i) begin
    if (some_q2) held <= {count_q2[C_W-1:0], y_q2, from_q2};
    held_q  <= !rst_i && !end_q2 && (some_q2 || held_q);
    valid_o <= !rst_i && ((some_q2 && held_q) || end_q2);
    run_o   <= {end_q2 && !held_q, end_q2, held};
  end

  // ---- credits: a slot of the consumer's for every line and every end; given back when it stays empty ---------------------------
  logic [CREDIT_LOG2:0] credit_q, credit;
  logic back_q;
  assign credit = credit_q + (CREDIT_LOG2 + 1)'(credit_i) + (CREDIT_LOG2 + 1)'(back_q)
                  - (CREDIT_LOG2 + 1)'(emit || finish);
  always_ff @(posedge clk_i) begin
    back_q        <= slot_q2 && !((some_q2 && held_q) || end_q2) && !rst_i;
    credit_q      <= credit;
    some_credit_q <= |credit_q[CREDIT_LOG2:1];  // two, as one may be spent in this clock
    if (rst_i) begin
      credit_q      <= (CREDIT_LOG2 + 1)'(1 << CREDIT_LOG2);
      some_credit_q <= 1'b1;
    end
  end
endmodule
