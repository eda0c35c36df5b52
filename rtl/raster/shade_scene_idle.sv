// SPDX-License-Identifier: Apache-2.0
// shade_scene_idle: is a triangle or a pixel under way? Counts what goes in and what comes out.
//
//   take_i        a packet of vertices is complete; told_i, end_i: it was skipped, it is through the depth test
//   run_valid_i   count_i pixels that are seen behind the depth test; pixel_i: one is drawn
//   busy_i        something waits between the two
//   idle_o        nothing is inside, and was not for 6 clocks: what the depth test has found is in its FIFO by then
//
// Example: take_i, then told_i.culled -> idle_o = 0, and 1 again.
module shade_scene_idle (
  input  logic                          clk_i,
  input  logic                          rst_i,
  input  logic                          take_i,
  input  shade_pkg::fate_t              told_i,
  input  logic                          end_i,
  input  logic                          run_valid_i,
  input  logic [shade_pkg::COUNT_W-1:0] count_i,
  input  logic                          pixel_i,
  input  logic                          busy_i,
  output logic                          idle_o
);
  localparam int TRIANGLES_W = 8;
  localparam int PIXELS_W = 20;
  logic [TRIANGLES_W-1:0] triangles_q;
  logic [PIXELS_W-1:0] pixels_q;
  logic [3:0] gone;
  logic [6:0] ends;
  logic [5:0] still_q;
  assign ends = told_i;
  assign gone = 4'($countones(ends)) + 4'(end_i);
  always_ff @(posedge clk_i) begin
    triangles_q <= triangles_q + TRIANGLES_W'(take_i) - TRIANGLES_W'(gone);
    pixels_q    <= pixels_q + (run_valid_i ? PIXELS_W'(count_i) : '0) - PIXELS_W'(pixel_i);
    still_q     <= {still_q[4:0], triangles_q == '0 && pixels_q == '0 && !take_i && !busy_i};
    idle_o      <= &still_q && !take_i;
    if (rst_i) begin
      triangles_q <= '0;
      pixels_q    <= '0;
      still_q     <= '0;
      idle_o      <= 1'b0;
    end
  end
  shade_assert u_triangles (.clk_i, .rst_i, .holds_i(TRIANGLES_W'(gone) <= triangles_q));
  shade_assert u_pixels (.clk_i, .rst_i, .holds_i(!pixel_i || pixels_q != '0));
endmodule
