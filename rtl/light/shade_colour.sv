// SPDX-License-Identifier: Apache-2.0
// shade_colour: what a pixel shows: ambient + kd max(0, diffuse) + ks max(0, specular), for red, green and blue.
//
//   light_i                 sd.ffff    S1.16, interpolated light
//   colour_i                 d.ffff    U1.16, ambient, kd, ks, of a channel each; taken with the light
//   sum                  sdddd.ffff    exact, rounded once, to nearest, ties up
//   pixel_o                   .ffff    U0.16, saturated to [0, 1 - 2^-16]: error at most 1/2 ulp
//
// Negative light, which polynomials give beside a lit region, is none. Six 18 x 18 multipliers.
// Latency LATENCY_COLOUR = 6 clocks, one pixel a clock. Source: P1, the sum of the light components.
// Example: diffuse = 1/2, specular = 1/4; ambient = 0.1, kd = ks = 1 -> 0.85.
module shade_colour (
  input  logic                  clk_i,
  input  shade_pkg::intensity_t light_i,
  input  shade_pkg::colour_t    colour_i,
  output shade_pkg::coloured_t  pixel_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int MUL = shade_pkg::LATENCY_MUL;

  shade_pkg::intensity_t light_q1;
  logic [2:0][F:0] kd_q1, ks_q1, ambient_q4;
  always_ff @(posedge clk_i) begin
    light_q1.diffuse  <= light_i.diffuse < 0 ? '0 : light_i.diffuse;
    light_q1.specular <= light_i.specular < 0 ? '0 : light_i.specular;
    kd_q1             <= colour_i.kd;
    ks_q1             <= colour_i.ks;
  end
  shade_delay #(.WIDTH($bits(ambient_q4)), .DEPTH(1 + MUL + 1)) u_ambient (
    .clk_i, .d_i(colour_i.ambient), .q_o(ambient_q4)
  );

  logic [2:0][shade_pkg::PIXEL_W-1:0] rgb_q6;
  for (genvar c = 0; c < 3; c++) begin : g_channel
    localparam int SUM_W = 2 * W + 2;
    localparam int TOTAL_W = SUM_W - F;
    logic signed [2*W-1:0] diffuse_q3, specular_q3;
    logic signed [SUM_W-1:0] light_q4, sum;
    logic signed [TOTAL_W-1:0] total_q5;
    logic [shade_pkg::PIXEL_W-1:0] saturated;
    shade_mul #(.A_W(W), .B_W(W)) u_diffuse (
      .clk_i, .a_i(light_q1.diffuse), .b_i({1'b0, kd_q1[c]}), .p_o(diffuse_q3)
    );
    shade_mul #(.A_W(W), .B_W(W)) u_specular (
      .clk_i, .a_i(light_q1.specular), .b_i({1'b0, ks_q1[c]}), .p_o(specular_q3)
    );
    shade_saturate #(.WIDTH(TOTAL_W), .OUT_W(shade_pkg::PIXEL_W)) u_saturate (.x_i(total_q5), .y_o(saturated));
    assign sum = light_q4 + SUM_W'($signed({1'b0, ambient_q4[c], 1'b1, {(F - 1) {1'b0}}}));
    always_ff @(posedge clk_i) begin
      light_q4  <= SUM_W'(diffuse_q3) + SUM_W'(specular_q3);
      total_q5  <= TOTAL_W'(sum >>> F);
      rgb_q6[c] <= saturated;
    end
  end
  assign pixel_o = rgb_q6;
endmodule
