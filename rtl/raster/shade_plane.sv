// SPDX-License-Identifier: Apache-2.0
// shade_plane: normal and depth at the first pixel of a triangle's first run; the runs pass through.
//
//   value = vertex 0 + (dcolumn (256 column + 128 - x) + dline (256 line + 128 - y)) / 2^8, to nearest, ties up, modulo 2^32
//
// pair_i: four pairs of increments a triangle, modulo 2^40 ulp, from here on whole pixels count, and 32 bits of them;
// kept in a FIFO of 64; head_i: vertex 0 and the box; run_i: see
// shade_raster, kept in a FIFO of 16 words, run_credit_o frees one. A triangle without a run is dropped.
// told_o: between, dropped for want of a run.
// surface_valid_o stands until surface_ready_i; the runs of a surface, behind it on run_valid_o, do not wait for it.
//
// One 35 x 18 multiplier (two blocks). 15 clocks a triangle, 23 a wide one; a run a clock.
// Example: dcolumn = 2^20, dline = 0, x = 128, column = 4 -> value = vertex 0 + 2^22.
module shade_plane (
  input  logic                clk_i,
  input  logic                rst_i,
  input  logic                pair_valid_i,
  input  shade_pkg::pair_t    pair_i,
  input  logic                head_valid_i,
  output logic                head_ready_o,
  input  shade_pkg::sized_t   head_i,
  input  logic                run_valid_i,
  input  shade_pkg::walked_t  run_i,
  output logic                run_credit_o,
  output logic                surface_valid_o,
  input  logic                surface_ready_i,
  output shade_pkg::surface_t surface_o,
  output logic                run_valid_o,
  input  logic                run_ready_i,
  output shade_pkg::walked_t  run_o,
  output shade_pkg::fate_t    told_o
);
  localparam int W = shade_pkg::COORDINATE_W;
  localparam int F = shade_pkg::SUBPIXEL_F;
  localparam int S_W = shade_pkg::STEP_W;
  localparam int C_W = shade_pkg::COUNT_W;
  localparam int WAIT_LOG2 = 4;
  localparam int PAIRS_LOG2 = 6;  // deep enough for block RAM
  localparam int G_W = shade_pkg::GROWTH_W;
  localparam int SUM_W = G_W;
  localparam int IN_W = 35;  // of the multiplier
  localparam int TOP_W = G_W - IN_W;

  // ---- what waits ---------------------------------------------------------------------------------------------------
  logic pair_some, pair_taken, run_some, run_take, unused_pair;
  shade_pkg::pair_t pair;
  shade_pkg::walked_t run;
  shade_fifo #(.WIDTH($bits(pair)), .LOG2(PAIRS_LOG2), .BLOCK(1)) u_pairs (
    .clk_i, .rst_i, .valid_i(pair_valid_i), .data_i(pair_i), .valid_o(pair_some), .ready_i(pair_taken), .data_o(pair),
    .taken_o(unused_pair)
  );
  shade_fifo #(.WIDTH($bits(run)), .LOG2(WAIT_LOG2)) u_runs (
    .clk_i, .rst_i, .valid_i(run_valid_i), .data_i(run_i), .valid_o(run_some), .ready_i(run_take), .data_o(run),
    .taken_o(run_credit_o)
  );

  // ---- control: of each triangle the runs move on, and four components are made, both at once ---------------------------
  logic moving_q, busy_q, drop_q, steep_q, start, move, step, whole, last_component;
  logic [1:0] component_q, part_q, parts;  // part: {upper half, line}
  logic [3:0] result_q;
  logic credit_q0;
  logic [WAIT_LOG2:0] credit_q;
  logic after_taken;
  logic surface_large_q;
  assign start        = head_valid_i && run_some && !moving_q && !busy_q && !surface_valid_o && result_q == '0;
  assign head_ready_o = start;
  assign move         = moving_q && run_some && credit_q0;
  assign run_take     = move || (start && run.none);
  assign parts        = {surface_large_q, 1'b0};
  assign step         = busy_q && pair_some;
  assign whole        = drop_q || part_q == 2'b01;
  assign last_component = component_q == 2'd3;
  assign pair_taken   = step && whole;
  always_ff @(posedge clk_i) begin
    moving_q <= !rst_i && ((start && !run.none) || (moving_q && !(move && run.last)));
    busy_q   <= !rst_i && (start || (busy_q && !(pair_taken && last_component)));
    told_o         <= '0;
    told_o.between <= start && run.none && !rst_i;
    if (start) drop_q <= run.none;
    if (start) steep_q <= 1'b0;
    else if (pair_taken && !last_component) steep_q <= steep_q || pair.steep;  // of a normal
    if (start) component_q <= 2'd0;
    else if (pair_taken) component_q <= component_q + 2'd1;
    if (start) part_q <= {head_i.wide, 1'b0};
    else if (step) part_q <= whole ? parts : {part_q[1] && !part_q[0], !part_q[0]};
    if (start) surface_large_q <= head_i.wide;
  end

  // the runs' second FIFO, so that the next triangle can be looked at
  shade_fifo #(.WIDTH($bits(run)), .LOG2(WAIT_LOG2)) u_after (
    .clk_i, .rst_i, .valid_i(move), .data_i(run), .valid_o(run_valid_o), .ready_i(run_ready_i), .data_o(run_o),
    .taken_o(after_taken)
  );
  logic [WAIT_LOG2:0] credit;
  assign credit = credit_q + (WAIT_LOG2 + 1)'(after_taken) - (WAIT_LOG2 + 1)'(move);
  always_ff @(posedge clk_i) begin
    credit_q  <= rst_i ? (WAIT_LOG2 + 1)'(1 << WAIT_LOG2) : credit;
    credit_q0 <= rst_i || credit != '0;
  end

  // ---- the way from vertex 0 ----------------------------------------------------------------------------------------------
  logic [1:0][W:0] way_q;  // line, column
  logic [W:0] way;
  logic [17:0] way_part;
  logic signed [G_W-1:0] growth;
  logic [IN_W+17:0] product_q3;
  logic [TOP_W-1:0] top_q3;
  logic [SUM_W-1:0] sum_q4, base, total;
  logic first_q3, shift_q3, first_q2, shift_q2, first_q1, shift_q1, result;
  assign way      = part_q[0] ? way_q[1] : way_q[0];
  assign way_part = part_q[1] ? {{(35 - W) {way[W]}}, way[W-1:17]} : {way[17] && !surface_large_q, way[16:0]};
  assign growth   = part_q[0] ? pair.line : pair.column;
  shade_mul #(.A_W(IN_W), .B_W(18), .STAGES(shade_pkg::LATENCY_MUL_IN)) u_mul (
    .clk_i, .a_i(growth[IN_W-1:0]), .b_i(way_part), .p_o(product_q3)
  );
  // what the multiplier leaves out above: so few bits of the result that a few adders make them
  logic [TOP_W-1:0] top_q1, way_q1, top_product;
  always_comb begin
    top_product = '0;
    for (int i = 0; i < TOP_W; i++) if (way_q1[i]) top_product = top_product + (top_q1 << i);
  end
  always_ff @(posedge clk_i) begin
    top_q1 <= growth[G_W-1:IN_W] + TOP_W'(growth[IN_W-1]);
    way_q1 <= way_part[TOP_W-1:0];
  end
  shade_delay #(.WIDTH(TOP_W), .DEPTH(shade_pkg::LATENCY_MUL_IN - 1)) u_top (.clk_i, .d_i(top_product), .q_o(top_q3));
  assign base    = first_q3 ? '0 : shift_q3 ? {sum_q4[SUM_W-18:0], 17'd0} : sum_q4;
  assign result  = pair_taken && !drop_q;
  always_ff @(posedge clk_i) begin
    if (start) begin
      way_q[0] <= (W + 1)'({run.column, {F{1'b1}}}) - head_i.corner.x;  // the centre plus 127, as x
      way_q[1] <= (W + 1)'({run.line, {F{1'b1}}}) - head_i.corner.y;
    end
    {first_q1, shift_q1} <= {part_q == parts, part_q == 2'b00};
    {first_q2, shift_q2} <= {first_q1, shift_q1};
    {first_q3, shift_q3} <= {first_q2, shift_q2};
    sum_q4               <= base + {product_q3[SUM_W-1:IN_W] + top_q3, product_q3[IN_W-1:0]};
    result_q             <= rst_i ? '0 : {result_q[2:0], result};
  end

  // ---- vertex 0 and the way, component by component ---------------------------------------------------------------------------
  logic [3:0][S_W-1:0] value_q, dcolumn_q, dline_q, vertex_q;
  logic [1:0] made_q;
  logic [C_W-1:0] columns_q, lines_q;
  logic [shade_pkg::PLACE_W-1:0] left_q;
  shade_pkg::site_t site_q;
  logic [shade_pkg::TAG_W:0] tag_q;
  logic unused_low;
  assign unused_low = ^{total[F-1:0], product_q3[IN_W+17:SUM_W]};
  logic [S_W-1:0] vertex;
  always_comb begin
    vertex = '0;
    for (int i = 0; i < 4; i++) vertex = vertex | ({S_W{made_q == 2'(i)}} & vertex_q[i]);
  end
  assign total  = sum_q4 + {vertex, 1'b1, {(F - 1) {1'b0}}};
  localparam int N_UP = shade_pkg::STEP_F - shade_pkg::VERTEX_F;
  localparam int Z_UP = shade_pkg::PLANE_F - shade_pkg::DEPTH_F;
  always_ff @(posedge clk_i) begin
    if (start) begin
      vertex_q  <= {S_W'({head_i.corner.depth, {Z_UP{1'b0}}}), S_W'($signed({head_i.corner.normal.z, {N_UP{1'b0}}})),
                    S_W'($signed({head_i.corner.normal.y, {N_UP{1'b0}}})),
                    S_W'($signed({head_i.corner.normal.x, {N_UP{1'b0}}}))};
      columns_q <= head_i.right - head_i.left;
      lines_q   <= head_i.bottom - C_W'(run.line);
      site_q    <= {run.line, run.column};
      left_q    <= run.column - head_i.left[shade_pkg::PLACE_W-1:0];
      tag_q     <= {head_i.corner.flat, head_i.corner.tag};
    end
    if (result_q[3]) value_q <= {total[SUM_W-1:F], value_q[3:1]};
    if (pair_taken) {dline_q, dcolumn_q} <= {pair.line[S_W-1:0], dline_q[3:1], pair.column[S_W-1:0], dcolumn_q[3:1]};
    made_q          <= start ? 2'd0 : made_q + 2'(result_q[3]);
    surface_valid_o <= !rst_i && ((result_q[3] && made_q == 2'd3) || (surface_valid_o && !surface_ready_i));
  end

  assign surface_o = {steep_q, tag_q, left_q, lines_q, columns_q, site_q, dline_q, dcolumn_q, value_q};
endmodule
