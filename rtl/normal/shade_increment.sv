// SPDX-License-Identifier: Apache-2.0
// shade_increment: interpolated normals by addition: from pixel to pixel, and from line to line.
//
//   first_i            P = L = n_i                 n_i: the normal at a triangle's (or line's) first pixel
//   line_i             P = L = L + l_i             l_i: increment from a line's first pixel to the next line's
//   otherwise          P = P + g_i                 g_i: increment per pixel, the same on all lines of a triangle
//
//   n_i, g_i, l_i      sdd.fff...   S2.29
//   n_o                 sd.ffff     S1.16, P rounded to nearest, ties up; sums wrap beyond [-4, 4), results beyond [-2, 2)
//
// With the increments rounded to S2.29, P is off by less than 1/4 ulp of S1.16 after 4096 of them.
// Without valid_i all stays. Latency LATENCY_INCREMENT = 2 clocks, one normal a clock. Source: P4, section 2 and results: the increment is that of
// the triangle, not of the line. Example: n = (0, 0, 1), g = (1/8, 0, 0): (0, 0, 1), (0.125, 0, 1), (0.25, 0, 1).
module shade_increment (
  input  logic             clk_i,
  input  logic             valid_i,
  input  logic             first_i,
  input  logic             line_i,
  input  shade_pkg::step_t n_i,
  input  shade_pkg::step_t g_i,
  input  shade_pkg::step_t l_i,
  output shade_pkg::vec_t  n_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int STEP_W = shade_pkg::STEP_W;
  localparam int DROP = shade_pkg::STEP_F - shade_pkg::INTENSITY_F;

  logic [2:0][STEP_W-1:0] n, g, l;
  logic [2:0][W-1:0] rounded, result_q;
  assign n   = n_i;
  assign g   = g_i;
  assign l   = l_i;
  assign n_o = result_q;
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [STEP_W-1:0] pixel_q, line_q, sum;
    assign sum = (line_i ? line_q : pixel_q) + $signed(line_i ? l[c] : g[c]);
    shade_round #(.WIDTH(STEP_W), .DROP(DROP), .OUT_W(W)) u_round (.x_i(pixel_q), .y_o(rounded[c]));
    always_ff @(posedge clk_i) begin
      if (valid_i) begin
        pixel_q <= first_i ? n[c] : sum;
        if (first_i || line_i) line_q <= first_i ? n[c] : sum;
      end
    end
  end
  always_ff @(posedge clk_i) result_q <= rounded;
endmodule
