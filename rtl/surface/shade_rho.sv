// SPDX-License-Identifier: Apache-2.0
// shade_rho: rho = 1/sqrt(P) - 1: by how much a normal of length sqrt(P) has to grow to length 1.
//
//   rho = c0 + s d,  s = c1 + c2 d          a parabola of P for each 1/128 of it, d = P - middle of the segment
//
// p_i U1.25. rho_o S0.25. short_o: P < 1/4, rho_o is then almost 1; long_o: P >= 129/128, a normal longer than 1.
// Roundings to nearest: s to 15 fraction bits, the result to 25; for tiny rho no bit is lost.
// Error below 3 ulp for P >= 1/2, below 20 (2^-20.7) for P >= 33/128; below that 2^-17.
// Latency LATENCY_RHO = 8 clocks, one result a clock. Example: P = 1/2 -> rho = 0.41421.
module shade_rho (
  input  logic                                          clk_i,
  input  logic        [shade_pkg::DIRECT_P_OUT_F:0]     p_i,
  output logic signed [shade_pkg::RHO_F:0]              rho_o,
  output logic                                          short_o,
  output logic                                          long_o
);
  localparam int P_F = shade_pkg::DIRECT_P_OUT_F;
  localparam int INDEX_W = shade_pkg::RHO_INDEX_W;
  localparam int D_W = P_F + 1 - INDEX_W;
  localparam int C0_W = shade_pkg::RHO_C0_W;
  localparam int C1_W = shade_pkg::INTENSITY_W;
  localparam int C2_W = shade_pkg::RHO_C2_W;
  localparam int DROP = shade_pkg::RHO_S_DROP;
  localparam int OUT_DROP = P_F + shade_pkg::RHO_C1_F - shade_pkg::RHO_F;

  // the table's row beside d
  logic [C0_W+C1_W+C2_W-1:0] row;
  logic signed [D_W-1:0] d_q, d_s;
  shade_rho_rom u_rom (.clk_i, .i_i(p_i[D_W+:INDEX_W]), .row_o(row));
  always_ff @(posedge clk_i) d_q <= {!p_i[D_W-1], p_i[D_W-2:0]};

  // s = c1 + c2 d
  logic signed [D_W+C2_W:0] bend;
  logic signed [C1_W-1:0] c1, s_q;
  logic signed [C0_W-1:0] c0;
  shade_mul #(.A_W(D_W), .B_W(C2_W + 1)) u_bend (.clk_i, .a_i(d_q), .b_i({1'b0, row[C2_W-1:0]}), .p_o(bend));
  shade_delay #(.WIDTH(C1_W), .DEPTH(2)) u_c1 (.clk_i, .d_i(row[C2_W+:C1_W]), .q_o(c1));
  shade_delay #(.WIDTH(C0_W), .DEPTH(5)) u_c0 (.clk_i, .d_i(row[C2_W+C1_W+:C0_W]), .q_o(c0));
  shade_delay #(.WIDTH(D_W), .DEPTH(3)) u_d (.clk_i, .d_i(d_q), .q_o(d_s));
  localparam logic signed [D_W+C2_W:0] HALF = (D_W + C2_W + 1)'(1) <<< (DROP - 1);
  always_ff @(posedge clk_i) s_q <= C1_W'(c1 + C1_W'((bend + HALF) >>> DROP));

  // rho = c0 + s d
  logic signed [D_W+C1_W-1:0] slope;
  shade_mul #(.A_W(D_W), .B_W(C1_W)) u_slope (.clk_i, .a_i(d_s), .b_i(s_q), .p_o(slope));
  localparam logic signed [D_W+C1_W-1:0] OUT_HALF = (D_W + C1_W)'(1) <<< (OUT_DROP - 1);
  logic signed [C0_W-1:0] c0_q, step_q;
  always_ff @(posedge clk_i) begin
    c0_q   <= c0;
    step_q <= C0_W'((slope + OUT_HALF) >>> OUT_DROP);
    rho_o  <= (shade_pkg::RHO_F + 1)'(c0_q + step_q);
  end

  logic short, long;
  assign short = p_i[P_F-:3] == 3'd0;
  assign long  = p_i[P_F] && p_i[P_F-1:D_W] != '0;
  shade_delay #(.WIDTH(2), .DEPTH(shade_pkg::LATENCY_RHO)) u_flags (.clk_i, .d_i({short, long}), .q_o({short_o, long_o}));
endmodule
