// SPDX-License-Identifier: Apache-2.0
// shade_scene_sweep: all pixels of a frame in scan order, one with every step_i.
//
// start_i begins with column 0 of line 0; busy_o: site_o stands there until step_i. last_column_o: the last of its line.
// No latency but that of the register. Example: 2 columns, 2 lines -> (0, 0), (1, 0), (0, 1), (1, 1).
module shade_scene_sweep (
  input  logic             clk_i,
  input  logic             rst_i,
  input  shade_pkg::view_t view_i,
  input  logic             start_i,
  input  logic             step_i,
  output logic             busy_o,
  output shade_pkg::site_t site_o,
  output logic             last_column_o
);
  localparam int C_W = shade_pkg::COUNT_W;
  logic last_line;
  assign last_column_o = C_W'(site_o.column) + C_W'(1) == view_i.columns;
  assign last_line     = C_W'(site_o.line) + C_W'(1) == view_i.lines;
  always_ff @(posedge clk_i) begin
    if (start_i) site_o <= '0;
    else if (step_i) begin
      site_o.column <= last_column_o ? '0 : site_o.column + 1'b1;
      if (last_column_o) site_o.line <= site_o.line + 1'b1;
    end
    busy_o <= !rst_i && (start_i || (busy_o && !(step_i && last_column_o && last_line)));
  end
  logic unused_view;
  assign unused_view = &{1'b0, view_i};
endmodule
