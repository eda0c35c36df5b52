// SPDX-License-Identifier: Apache-2.0
// shade_increment: interpolated normals by addition: from pixel to pixel, and from line to line.
//
//   first_i            P = L = n_i                 n_i: the normal at a triangle's (or line's) first pixel
//   line_i             P = L = L + l_i             l_i: increment from a line's first pixel to the next line's
//   otherwise          P = P + g_i                 g_i: increment per pixel, the same on all lines of a triangle
//
//   *n_i, *g_i, *l_i   sdd.fff...   S2.29
//   x_o, y_o, z_o       sd.ffff     S1.16, P rounded to nearest, ties up; sums wrap beyond [-4, 4), results beyond [-2, 2)
//
// With the increments rounded to S2.29, P is off by less than 1/4 ulp of S1.16 after 4096 of them.
// Latency LATENCY_INCREMENT = 2 clocks, one normal a clock. Source: P4, section 2 and results: the increment is that of
// the triangle, not of the line. Example: n = (0, 0, 1), g = (1/8, 0, 0): (0, 0, 1), (0.125, 0, 1), (0.25, 0, 1).
module shade_increment (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  input  logic                                     first_i,
  input  logic                                     line_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] xn_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] yn_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] zn_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] xg_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] yg_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] zg_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] xl_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] yl_i,
  input  logic signed [     shade_pkg::STEP_W-1:0] zl_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] z_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int STEP_W = shade_pkg::STEP_W;
  localparam int DROP = shade_pkg::STEP_F - shade_pkg::INTENSITY_F;
  localparam int ALL_W = STEP_W + STEP_W + STEP_W;

  logic [ALL_W-1:0] n, g, l;
  logic [W+W+W-1:0] result;
  assign n = {xn_i, yn_i, zn_i};
  assign g = {xg_i, yg_i, zg_i};
  assign l = {xl_i, yl_i, zl_i};
  for (genvar c = 0; c < 3; c++) begin : g_component
    localparam int LSB = c * STEP_W;
    localparam int OUT_LSB = c * W;
    logic signed [STEP_W-1:0] pixel_q, line_q, sum;
    logic signed [W-1:0] rounded, result_q;
    assign sum = (line_i ? line_q : pixel_q) + $signed(line_i ? l[LSB+:STEP_W] : g[LSB+:STEP_W]);
    shade_round #(.WIDTH(STEP_W), .DROP(DROP), .OUT_W(W)) u_round (.x_i(pixel_q), .y_o(rounded));
    always_ff @(posedge clk_i) begin
      if (valid_i) begin
        pixel_q <= first_i ? n[LSB+:STEP_W] : sum;
        if (first_i || line_i) line_q <= first_i ? n[LSB+:STEP_W] : sum;
      end
      result_q <= rounded;
    end
    assign result[OUT_LSB+:W] = result_q;
  end
  assign {x_o, y_o, z_o} = result;

  shade_valid #(.DEPTH(shade_pkg::LATENCY_INCREMENT)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
