// SPDX-License-Identifier: Apache-2.0
// shade_colour: what a pixel shows: ambient + kd max(0, diffuse) + ks max(0, specular), for red, green and blue.
//
//   diffuse_i, specular_i   sd.ffff    S1.16, interpolated light
//   ambient, kd, ks          d.ffff    U1.16, of a channel each; taken with the light
//   sum                  sdddd.ffff    exact, rounded once, to nearest, ties up
//   r_o, g_o, b_o             .ffff    U0.16, saturated to [0, 1 - 2^-16]: error at most 1/2 ulp
//
// Negative light, which polynomials give beside a lit region, is none. Six 18 x 18 multipliers.
// Latency LATENCY_COLOUR = 6 clocks, one pixel a clock. Source: P1, the sum of the light components.
// Example: diffuse = 1/2, specular = 1/4; ambient = 0.1, kd = ks = 1 -> 0.85.
module shade_colour (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] diffuse_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] specular_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] ambient_r_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] ambient_g_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] ambient_b_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] kd_r_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] kd_g_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] kd_b_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] ks_r_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] ks_g_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] ks_b_i,
  output logic                                     valid_o,
  output logic        [    shade_pkg::PIXEL_W-1:0] r_o,
  output logic        [    shade_pkg::PIXEL_W-1:0] g_o,
  output logic        [    shade_pkg::PIXEL_W-1:0] b_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int K_W = F + 1;
  localparam int MUL = shade_pkg::LATENCY_MUL;

  logic signed [W-1:0] diffuse_q1, specular_q1;
  logic [3*K_W-1:0] kd_q1, ks_q1, ambient_q4;
  always_ff @(posedge clk_i) begin
    diffuse_q1  <= diffuse_i[W-1] ? '0 : diffuse_i;
    specular_q1 <= specular_i[W-1] ? '0 : specular_i;
    kd_q1       <= {kd_b_i, kd_g_i, kd_r_i};
    ks_q1       <= {ks_b_i, ks_g_i, ks_r_i};
  end
  shade_delay #(.WIDTH(3 * K_W), .DEPTH(1 + MUL + 1)) u_ambient (
    .clk_i, .d_i({ambient_b_i, ambient_g_i, ambient_r_i}), .q_o(ambient_q4)
  );

  logic [3*shade_pkg::PIXEL_W-1:0] rgb;
  for (genvar c = 0; c < 3; c++) begin : g_channel
    localparam int SUM_W = 2 * W + 2;
    localparam int TOTAL_W = SUM_W - F;
    logic signed [2*W-1:0] diffuse_q3, specular_q3;
    logic signed [SUM_W-1:0] light_q4, sum;
    logic signed [TOTAL_W-1:0] total_q5;
    logic [shade_pkg::PIXEL_W-1:0] saturated, rgb_q6;
    shade_mul #(.A_W(W), .B_W(W)) u_diffuse (
      .clk_i, .a_i(diffuse_q1), .b_i($signed({1'b0, kd_q1[c*K_W+:K_W]})), .p_o(diffuse_q3)
    );
    shade_mul #(.A_W(W), .B_W(W)) u_specular (
      .clk_i, .a_i(specular_q1), .b_i($signed({1'b0, ks_q1[c*K_W+:K_W]})), .p_o(specular_q3)
    );
    shade_saturate #(.WIDTH(TOTAL_W), .OUT_W(shade_pkg::PIXEL_W)) u_saturate (.x_i(total_q5), .y_o(saturated));
    assign sum = light_q4 + SUM_W'($signed({1'b0, ambient_q4[c*K_W+:K_W], 1'b1, {(F - 1) {1'b0}}}));
    always_ff @(posedge clk_i) begin
      light_q4 <= SUM_W'(diffuse_q3) + SUM_W'(specular_q3);
      total_q5 <= TOTAL_W'(sum >>> F);
      rgb_q6   <= saturated;
    end
    assign rgb[c*shade_pkg::PIXEL_W+:shade_pkg::PIXEL_W] = rgb_q6;
  end
  assign {b_o, g_o, r_o} = rgb;

  shade_valid #(.DEPTH(shade_pkg::LATENCY_COLOUR)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
