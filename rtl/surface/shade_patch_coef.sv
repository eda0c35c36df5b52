// SPDX-License-Identifier: Apache-2.0
// shade_patch_coef: from the light at six nodes, one after the other, to what a box's lines start from, in one channel.
//
//   light_i     S1.16, node 0 .. 5 (C, E, A, B, F, G of golden.patch) in node_i, with valid_i
//   load_i      the box is complete, a clock after its last node at the earliest; what follows stays until the next load_i:
//   ct_o        2 C - 2 t           2 s = A + B - F - G, 2 t = A + F - B - G, p = 4 (E - C) - 2 s, q = A - B - F + G,
//   r_o         r = 2 (A + B) - 4 E
//   u_o         2 t - 4 r
//   s_o, q_o, p_o
//
// Exact; widths for nodes in [-2, 2). Shifts and adders alone. Latency 1 clock behind load_i.
// Example: all nodes 1 -> ct = 2, others 0.
module shade_patch_coef (
  input  logic                                     clk_i,
  input  logic                                     valid_i,
  input  logic        [                       2:0] node_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] light_i,
  input  logic                                     load_i,
  output logic signed [shade_pkg::INTENSITY_W+1:0] ct_o,
  output logic signed [shade_pkg::INTENSITY_W+3:0] r_o,
  output logic signed [shade_pkg::INTENSITY_W+5:0] u_o,
  output logic signed [shade_pkg::INTENSITY_W+1:0] s_o,
  output logic signed [shade_pkg::INTENSITY_W+1:0] q_o,
  output logic signed [shade_pkg::INTENSITY_W+4:0] p_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int S_W = W + 2;
  logic signed [W-1:0] c_q, e_q;
  logic signed [S_W-1:0] s_q, t_q, q_q, ab_q, light;
  logic first, s_less, t_less, q_less;
  assign light  = S_W'(light_i);
  assign first  = node_i == 3'd2;
  assign s_less = node_i[2];
  assign t_less = node_i[0];
  assign q_less = node_i == 3'd3 || node_i == 3'd4;
  function automatic logic signed [S_W-1:0] sum(
    input logic signed [S_W-1:0] to, input logic signed [S_W-1:0] what, input logic new_sum, input logic less
  );
    sum = $signed(S_W'(({to & {S_W{!new_sum}}, 1'b1} + {what ^ {S_W{less}}, less}) >> 1));
  endfunction
  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      if (node_i == 3'd0) c_q <= light_i;
      if (node_i == 3'd1) e_q <= light_i;
      s_q <= sum(s_q, light, first, s_less);
      t_q <= sum(t_q, light, first, t_less);
      q_q <= sum(q_q, light, first, q_less);
      if (!node_i[2]) ab_q <= sum(ab_q, light, first, 1'b0);
    end
    if (load_i) begin
      ct_o <= ((W + 2)'(c_q) <<< 1) - (W + 2)'(t_q);  // modulo 2^20
      r_o  <= ((W + 4)'(ab_q) <<< 1) - ((W + 4)'(e_q) <<< 2);
      u_o  <= (W + 6)'(t_q) - ((W + 6)'(ab_q) <<< 3) + ((W + 6)'(e_q) <<< 4);
      s_o  <= s_q;
      q_o  <= q_q;
      p_o  <= (((W + 5)'(e_q) - (W + 5)'(c_q)) <<< 2) - (W + 5)'(s_q);
    end
  end
endmodule
