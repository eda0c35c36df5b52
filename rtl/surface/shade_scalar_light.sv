// SPDX-License-Identifier: Apache-2.0
// shade_scalar_light: one light's diffuse and specular part from its scalars a = N.L, h = N.H and from rho = 1/sqrt(N.N) - 1.
//
//   diffuse = a + a rho,  y = 1 - h,  x = 1 - cos = y - rho + y rho,  specular = lobe(x)
//
//   a_i, h_i      S1.17, S1.24;   rho_i S0.25, of shade_rho: LATENCY_RHO clocks behind them
//   excess_i      |H| - 1 of the quantized H, which makes x the angle to H all the same
//   diffuse_o     SIGNED = 0: U0.16, saturated, SIGNED = 1: S1.16, limited, to be interpolated
//   specular_o    U0.16; N.H < 0 gives none. Other ports: see shade_chord
//
// Where the highlight is y and rho are small: nothing cancels; x is right to (rho + y) 2^-17 + 2^-23. Products take rho and y with
// 17, a with 16 fraction bits. MEMORY = 1: what waits for rho stands in a small memory, in place of a quarter of all registers.
// Latency LATENCY_DIRECT_LIGHT = 17 clocks, one light a clock. Example: a = 1/2, rho = 1 -> diffuse = 1 - 2^-16.
module shade_scalar_light #(
  parameter int SIGNED = 0,
  parameter int MEMORY = 0
) (
  input  logic                                        clk_i,
  input  logic                                        rst_i,
  input  logic                                        write_i,
  input  logic        [shade_pkg::CHORD_INDEX_W-1:0]  address_i,
  input  shade_pkg::chord_t                           chord_i,
  input  logic        [shade_pkg::CHORD_SHIFT_W-1:0]  shift_i,
  input  logic signed [shade_pkg::EXCESS_W-1:0]       excess_i,
  input  logic signed [shade_pkg::DIRECT_DIFFUSE_F+1:0] a_i,
  input  logic signed [shade_pkg::DIRECT_X_F+1:0]     h_i,
  input  logic signed [shade_pkg::RHO_F:0]            rho_i,
  output logic signed [shade_pkg::INTENSITY_W-1:0]    diffuse_o,
  output logic        [shade_pkg::PIXEL_W-1:0]        specular_o
);
  if (SIGNED < 0 || SIGNED > 1 || MEMORY < 0 || MEMORY > 1) begin : g_check
    $error("shade_scalar_light: SIGNED and MEMORY must be 0 or 1");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int A_F = shade_pkg::DIRECT_DIFFUSE_F;
  localparam int A_W = A_F + 2;
  localparam int X_F = shade_pkg::DIRECT_X_F;
  localparam int X_W = X_F + 3;
  localparam int RHO_F = shade_pkg::RHO_F;
  localparam int LATENCY_RHO = shade_pkg::LATENCY_RHO;
  localparam int PRODUCT_F = shade_pkg::INTENSITY_F + shade_pkg::DIRECT_RHO_F;

  // ---- what waits for rho -------------------------------------------------------------------------------------------
  logic signed [A_W-1:0] a;
  logic [X_F+1:0] h;
  logic signed [X_F:0] y;
  if (MEMORY == 1) begin : g_memory
    shade_ring #(.WIDTH(A_W + X_F + 2), .DEPTH(LATENCY_RHO)) u_wait (.clk_i, .rst_i, .d_i({a_i, h_i}), .q_o({a, h}));
  end else begin : g_registers
    // in two halves, which are shift registers: no memory
    localparam int HALF = LATENCY_RHO / 2;
    logic [A_W+X_F+1:0] half_way;
    shade_delay #(.WIDTH(A_W + X_F + 2), .DEPTH(HALF)) u_early (.clk_i, .d_i({a_i, h_i}), .q_o(half_way));
    shade_delay #(.WIDTH(A_W + X_F + 2), .DEPTH(LATENCY_RHO - HALF)) u_late (.clk_i, .d_i(half_way), .q_o({a, h}));
    logic unused_reset;
    assign unused_reset = rst_i;
  end
  assign y = {h[X_F], ~h[X_F-1:0]};  // 1 - h, less an ulp of h; of h < 0 it does not matter

  // ---- products -----------------------------------------------------------------------------------------------------
  logic signed [W-1:0] factor, a_high, y_low;
  logic signed [2*W-1:0] grown, bent;
  assign factor = rho_i[RHO_F-:W];
  assign a_high = a[A_W-1-:W];
  assign y_low  = y[X_F-:W];
  shade_mul #(.A_W(W), .B_W(W)) u_grown (.clk_i, .a_i(a_high), .b_i(factor), .p_o(grown));
  shade_mul #(.A_W(W), .B_W(W)) u_bent (.clk_i, .a_i(y_low), .b_i(factor), .p_o(bent));
  logic signed [A_W-1:0] a_p;
  logic signed [X_W-1:0] difference_q, difference_p;
  logic dark_p;
  always_ff @(posedge clk_i) difference_q <= X_W'(y) - X_W'(rho_i >>> 1) + X_W'(excess_i);
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
  localparam int OUT_W = SIGNED == 1 ? W : PIXEL_W;
  logic [OUT_W-1:0] diffuse_q, diffuse;
  if (SIGNED == 1) begin : g_signed
    logic signed [A_W-1:0] total;
    logic signed [W-1:0] fit;
    assign total = total_q[A_W:1];
    shade_limit #(.WIDTH(A_W), .OUT_W(W)) u_fit (.x_i(total), .y_o(fit));
    always_ff @(posedge clk_i) diffuse_q <= fit;
    assign diffuse_o = diffuse;
  end else begin : g_pixel
    always_ff @(posedge clk_i) begin
      diffuse_q <= total_q[PIXEL_W:1];
      if (total_q[A_W:PIXEL_W+1] != '0) diffuse_q <= '1;
      if (total_q < 0) diffuse_q <= '0;
    end
    assign diffuse_o = {2'b00, diffuse};
  end
  shade_delay #(.WIDTH(OUT_W), .DEPTH(shade_pkg::LATENCY_CHORD - 1)) u_diffuse (.clk_i, .d_i(diffuse_q), .q_o(diffuse));
  shade_chord u_chord (.clk_i, .write_i, .address_i, .chord_i, .shift_i, .x_i(x_q), .dark_i(dark_q), .specular_o);

  logic unused_bits;
  assign unused_bits = &{1'b0, bent, grown, low_q, total_q[0]};
endmodule
