// SPDX-License-Identifier: Apache-2.0
// shade_patch_nodes: N.L, N.H and N.N where a box is lit: at its six nodes, or at each of its pixels.
//
//   dot_i     the products of shade_patch_dots, taken with dot_ready_o
//   place_i   of shade_patch_walk, taken with place_ready_o: with a box's last node
//   room_i    stops the walk; up to two nodes still come
//   node_o    {N.N, N.H, N.L} at i, j quarters of a box from its middle, S4.22, modulo 16:
//             N.L + i L.dx + j L.dy;   N.N + 2 i N.dx + 2 j N.dy + i^2 dx.dx + 2 i j dx.dy + j^2 dy.dy
//             i, j of nodes: (0, 0), (1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1); of pixels: column, line - 2
//   meta_valid_o, meta_o   {direct, deep, kx, ky, column, line, tag} once a box, or for every pixel, in time for its first light
//
// The next box's products are taken while a box is at work. No multiplier. A node a clock. Latency LATENCY_PATCH_NODES = 4.
// Example: N.L = 1, L.dx = 1/4, others 0 -> 1, 5/4, 5/4, 5/4, 3/4, 3/4.
module shade_patch_nodes (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  logic                                 dot_valid_i,
  output logic                                 dot_ready_o,
  input  logic [                          3:0] which_i,
  input  logic [   shade_pkg::PATCH_DOT_W-1:0] dot_i,
  input  logic                                 place_valid_i,
  output logic                                 place_ready_o,
  input  logic [ shade_pkg::PATCH_PLACE_W-1:0] place_i,
  input  logic                                 room_i,
  output logic                                 valid_o,
  output logic [ 3*shade_pkg::PATCH_DOT_W-1:0] node_o,
  output logic                                 meta_valid_o,
  output logic [  shade_pkg::PATCH_META_W-1:0] meta_o
);
  localparam int W = shade_pkg::PATCH_DOT_W;
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int DOTS = 12;  // L.dx .. dy.dy, N.L .. N.dy: see shade_patch_dots

  logic unused_first, direct;
  logic [LOG2-1:0] deep;
  logic [15:0] pixels;
  logic [PLACE_W-1:0] column, line;
  logic [TAG_W-1:0] tag;
  logic [2:0] kx, ky;
  assign {unused_first, direct, deep, pixels, column, line, tag, kx, ky} = place_i;

  // ---- products: of the next box, and of the one at hand ---------------------------------------------------------------------
  logic [DOTS*W-1:0] next_q, dots_q;
  logic full_q, start, start_q, busy_q, step, last;
  assign dot_ready_o = !full_q;
  assign start       = full_q && (!busy_q || (step && last));
  for (genvar i = 0; i < DOTS; i++) begin : g_dot
    always_ff @(posedge clk_i) if (dot_valid_i && !full_q && which_i == 4'(i)) next_q[i*W+:W] <= dot_i;
  end
  always_ff @(posedge clk_i) begin
    start_q <= start;
    if (start_q) dots_q <= next_q;  // behind the last node of the box before
    if (start) full_q <= 1'b0;
    else if (dot_valid_i && which_i == 4'(DOTS - 1)) full_q <= 1'b1;
    if (start) busy_q <= 1'b1;
    else if (step && last) busy_q <= 1'b0;
    if (rst_i) {full_q, busy_q} <= 2'b00;
  end

  // ---- the walk: node 0 .. 5, or the pixels that are left ----------------------------------------------------------------------
  logic begin_q;  // of a box
  logic [2:0] node_q;
  logic [15:0] left, left_q, rest;
  logic [3:0] pixel;
  logic signed [1:0] i, j;
  assign step          = busy_q && place_valid_i && room_i;
  assign place_ready_o = step && last;
  assign left          = begin_q ? pixels : left_q;
  assign rest          = left & (left - 16'd1);
  always_comb begin
    pixel = '0;
    for (int n = 15; n >= 0; n--) if (left[n]) pixel = 4'(n);
    last = direct ? rest == '0 : node_q == 3'd5;
    // -2 .. 1 of a pixel is its place less 2: the upper bit turned over
    if (direct) {j, i} = pixel ^ 4'b1010;
    else begin
      i = node_q == 3'd0 ? 2'sd0 : node_q[2] ? -2'sd1 : 2'sd1;
      j = node_q[2:1] == 2'd0 ? 2'sd0 : node_q[0] ? -2'sd1 : 2'sd1;
    end
  end
  always_ff @(posedge clk_i) begin
    if (start || (step && last)) begin
      begin_q <= 1'b1;
      node_q  <= '0;
    end else if (step) begin
      begin_q <= 1'b0;
      node_q  <= node_q + 3'd1;
    end
    if (step) left_q <= rest;
    meta_o       <= {direct, deep, kx, ky, column + (direct ? PLACE_W'(pixel[1:0]) : '0),
                     line + (direct ? PLACE_W'(pixel[3:2]) : '0), tag};
    meta_valid_o <= step && (direct || begin_q) && !rst_i;
  end

  // ---- sums ----------------------------------------------------------------------------------------------------------------------
  // f times -2 .. 1, less 1 where it is negative: the ones' complement, for which a carry is due; f times 0, 1, 4
  function automatic logic [W-1:0] times(input logic [W-1:0] f, input logic [1:0] n);
    times = n == 2'd0 ? '0 : n == 2'd1 ? f : n == 2'd3 ? ~f : ~(f << 1);
  endfunction
  function automatic logic [W-1:0] sum(input logic [W-1:0] a, input logic [W-1:0] b, input logic carry);
    sum = W'(({a, 1'b1} + {b, carry}) >> 1);
  endfunction
  function automatic logic signed [W-1:0] square(input logic signed [W-1:0] f, input logic signed [1:0] n);
    square = n == 2'sd0 ? '0 : n == -2'sd2 ? f << 2 : f;
  endfunction
  logic signed [W-1:0] lx, ly, hx, hy, xx, xy, yy, nl, nh, nn, nx, ny;
  assign {ny, nx, nn, nh, nl, yy, xy, xx, hy, hx, ly, lx} = dots_q;
  logic signed [1:0] i_q1, j_q1;
  logic signed [W-1:0] l_q2, lj_q2, h_q2, hj_q2, p_q2, pj_q2, pp_q2, pq_q2;
  logic j_q2, pair_q2;  // is negative
  logic signed [W-1:0] l_q3, h_q3, p_q3, pp_q3;
  // 2 i j dx.dy, ones' complement where i j < 0
  logic negative;
  logic [W-1:0] pair;
  assign negative = (i_q1[1] ^ j_q1[1]) && i_q1 != '0 && j_q1 != '0;
  always_comb begin
    pair = xy << 1;
    if (i_q1 == 2'b10) pair = pair << 1;
    if (j_q1 == 2'b10) pair = pair << 1;
    if (i_q1 == '0 || j_q1 == '0) pair = '0;
    if (negative) pair = ~pair;
  end
  always_ff @(posedge clk_i) begin
    {i_q1, j_q1} <= {i, j};
    l_q2    <= sum(nl, times(lx, i_q1), i_q1[1]);
    lj_q2   <= times(ly, j_q1);
    h_q2    <= sum(nh, times(hx, i_q1), i_q1[1]);
    hj_q2   <= times(hy, j_q1);
    p_q2    <= sum(nn, times(nx << 1, i_q1), i_q1[1]);
    pj_q2   <= times(ny << 1, j_q1);
    pp_q2   <= square(xx, i_q1) + square(yy, j_q1);
    pq_q2   <= pair;
    j_q2    <= j_q1[1];
    pair_q2 <= negative;
    l_q3    <= sum(l_q2, lj_q2, j_q2);
    h_q3    <= sum(h_q2, hj_q2, j_q2);
    p_q3    <= sum(p_q2, pj_q2, j_q2);
    pp_q3   <= sum(pp_q2, pq_q2, pair_q2);
    node_o <= {p_q3 + pp_q3, h_q3, l_q3};
  end
  shade_valid #(.DEPTH(shade_pkg::LATENCY_PATCH_NODES)) u_valid (.clk_i, .rst_i, .valid_i(step), .valid_o);
endmodule
