// SPDX-License-Identifier: Apache-2.0
// shade_direct_light: diffuse and specular light of a pixel from its scalars a = N.L, h = N.H, P = N.N.
//
//   rho = 1/sqrt(P) - 1,  diffuse = a + a rho,  y = 1 - h,  x = 1 - cos = y - rho + y rho,  specular = lobe(x)
//
// Where the highlight is y and rho are small: nothing cancels; x is right to (rho + y) 2^-17 + 2^-23. Three products here.
// Of a 17, of y 24, of P 25 fraction bits are taken; products take rho and y with 17, a with 16 of them. H is not exactly
// of length 1 when quantized: excess_i = |H| - 1 makes x the angle to H all the same.
// pixel_o U0.16, saturated; N.H < 0 gives no specular light. short_o, long_o: see shade_rho. Other ports: see shade_chord.
// Error: docs and build/units.json. Latency LATENCY_DIRECT_LIGHT = 17 clocks, one pixel a clock.
// Example: a = 1/2, P = 1/4 (a normal of length 1/2 to the light) -> rho = 1, diffuse = 1.
module shade_direct_light (
  input  logic                                        clk_i,
  input  logic                                        write_i,
  input  logic        [shade_pkg::CHORD_INDEX_W-1:0]  address_i,
  input  shade_pkg::chord_t                           chord_i,
  input  logic        [shade_pkg::CHORD_SHIFT_W-1:0]  shift_i,
  input  logic signed [shade_pkg::EXCESS_W-1:0]       excess_i,
  input  shade_pkg::scalars_t                         scalars_i,
  output shade_pkg::pixel_t                           pixel_o,
  output logic                                        short_o,
  output logic                                        long_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int A_F = shade_pkg::DIRECT_DIFFUSE_F;
  localparam int A_W = A_F + 2;
  localparam int X_F = shade_pkg::DIRECT_X_F;
  localparam int X_W = X_F + 3;
  localparam int RHO_F = shade_pkg::RHO_F;
  localparam int LATENCY_RHO = shade_pkg::LATENCY_RHO;
  localparam int PRODUCT_F = shade_pkg::INTENSITY_F + shade_pkg::DIRECT_RHO_F;

  // ---- rho, and what waits for it ---------------------------------------------------------------------------------
  logic signed [RHO_F:0] rho;
  logic short, long;
  shade_rho u_rho (
    .clk_i, .p_i(scalars_i.p[shade_pkg::DIRECT_P_W-1-:shade_pkg::DIRECT_P_OUT_F+1]), .rho_o(rho), .short_o(short),
    .long_o(long)
  );
  logic signed [A_W-1:0] a;
  logic [X_F+1:0] h;
  logic signed [X_F:0] y;
  // in two halves, which are shift registers: no memory
  localparam int HALF = LATENCY_RHO / 2;
  logic [A_W+X_F+1:0] half_way;
  shade_delay #(.WIDTH(A_W + X_F + 2), .DEPTH(HALF)) u_early (
    .clk_i, .d_i({scalars_i.a[shade_pkg::DIRECT_A_W-1-:A_W], scalars_i.h[shade_pkg::DIRECT_H_W-1-:X_F+2]}),
    .q_o(half_way)
  );
  shade_delay #(.WIDTH(A_W + X_F + 2), .DEPTH(LATENCY_RHO - HALF)) u_late (
    .clk_i, .d_i(half_way), .q_o({a, h})
  );
  assign y = {h[X_F], ~h[X_F-1:0]};  // 1 - h, less an ulp of h; of h < 0 it does not matter

  // ---- products -----------------------------------------------------------------------------------------------------
  logic signed [W-1:0] factor;
  logic signed [2*W-1:0] grown, bent;
  assign factor = rho[RHO_F-:W];
  shade_mul #(.A_W(W), .B_W(W)) u_grown (.clk_i, .a_i(a[A_W-1-:W]), .b_i(factor), .p_o(grown));
  shade_mul #(.A_W(W), .B_W(W)) u_bent (.clk_i, .a_i(y[X_F-:W]), .b_i(factor), .p_o(bent));
  logic signed [A_W-1:0] a_p;
  logic signed [X_W-1:0] difference_q, difference_p;
  logic dark_p;
  always_ff @(posedge clk_i) difference_q <= X_W'(y) - X_W'(rho >>> 1) + X_W'(excess_i);
  always_ff @(posedge clk_i) difference_p <= difference_q;
  shade_delay #(.WIDTH(A_W), .DEPTH(2)) u_a (.clk_i, .d_i(a), .q_o(a_p));
  shade_delay #(.WIDTH(1), .DEPTH(2)) u_dark (.clk_i, .d_i(h[X_F+1]), .q_o(dark_p));

  // ---- sums -----------------------------------------------------------------------------------------------------------
  // half an ulp of a pixel is the carry into the sum's lowest bit
  logic signed [A_W:0] total_q;
  logic low_q;
  logic signed [X_W-1:0] x_q;
  logic dark_q;
  always_ff @(posedge clk_i) begin
    {total_q, low_q} <= {(A_W + 1)'(a_p), 1'b1} + {(A_W + 1)'(grown >>> (PRODUCT_F - A_F)), 1'b1};
    x_q     <= difference_p + X_W'(bent >>> (2 * shade_pkg::DIRECT_RHO_F - X_F));
    dark_q  <= dark_p;
  end

  // ---- light ----------------------------------------------------------------------------------------------------------
  localparam int PIXEL_W = shade_pkg::PIXEL_W;
  logic [PIXEL_W-1:0] diffuse_q;
  always_ff @(posedge clk_i) begin
    diffuse_q <= total_q[PIXEL_W:1];
    if (total_q[A_W:PIXEL_W+1] != '0) diffuse_q <= '1;
    if (total_q < 0) diffuse_q <= '0;
  end
  shade_delay #(.WIDTH(PIXEL_W), .DEPTH(shade_pkg::LATENCY_CHORD - 1)) u_wait (
    .clk_i, .d_i(diffuse_q), .q_o(pixel_o.diffuse)
  );
  shade_chord u_chord (
    .clk_i, .write_i, .address_i, .chord_i, .shift_i, .x_i(x_q), .dark_i(dark_q), .specular_o(pixel_o.specular)
  );
  shade_delay #(.WIDTH(2), .DEPTH(shade_pkg::LATENCY_DIRECT_LIGHT - LATENCY_RHO)) u_flags (
    .clk_i, .d_i({short, long}), .q_o({short_o, long_o})
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, scalars_i, bent, grown, low_q, total_q[0]};
endmodule
