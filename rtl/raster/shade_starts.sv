// SPDX-License-Identifier: Apache-2.0
// shade_starts: what a triangle's normal and depth are at the first pixel of each of its runs.
//
//   value = surface value + dcolumn (column - surface column) + dline (line - surface line), modulo 4, exact
//
// by additions alone: from run to run a step a line down and a step a column aside. surface_i is taken with its first run,
// and one run after the other until that with last; runs come line by line, several on a line are allowed. begun_o: a run,
// its triangle, and the value there; it stands until ready_i. A run that is none is passed on, without moves.
//
// No multiplier. A run in a clock, one more for every line without a run and for every column aside, as many as
// shade_raster takes. No path from an input to valid_o; ready_i leads to run_ready_o.
// Example: dcolumn = 5, dline = 7; the second run is a line below and 2 columns to the left: value - 10 + 7, 3 clocks.
module shade_starts (
  input  logic                clk_i,
  input  logic                rst_i,
  input  logic                surface_valid_i,
  output logic                surface_ready_o,
  input  shade_pkg::surface_t surface_i,
  input  logic                run_valid_i,
  output logic                run_ready_o,
  input  shade_pkg::walked_t  run_i,
  output logic                valid_o,
  input  logic                ready_i,
  output shade_pkg::begun_t   begun_o
);
  localparam int S_W = shade_pkg::STEP_W;
  localparam int P_W = shade_pkg::PLACE_W;
  localparam int COMPONENTS = 4;

  // ---- a run, and the way to it from the one before, or from the surface's pixel -----------------------------------------
  logic full_q1, first_q1, next_first_q, take, load;
  shade_pkg::walked_t run_q1;
  shade_pkg::site_t from_q, from;
  logic signed [P_W:0] lines_q1, columns_q1;  // lines: less the one that is made as the run moves on
  assign from        = next_first_q ? surface_i.site : from_q;
  assign run_ready_o = (!full_q1 || load) && (!next_first_q || (surface_valid_i && !(full_q1 && first_q1)));
  assign take        = run_valid_i && run_ready_o;
  always_ff @(posedge clk_i) begin
    if (take) begin
      run_q1       <= run_i;
      first_q1     <= next_first_q;
      next_first_q <= run_i.last;
      lines_q1     <= run_i.none ? '1 : {1'b0, run_i.line} - {1'b0, from.line} - (P_W + 1)'(!next_first_q);
      columns_q1   <= run_i.none ? '0 : {1'b0, run_i.column} - {1'b0, from.column};
      if (!run_i.none) from_q <= {run_i.line, run_i.column};
    end
    full_q1 <= take || (full_q1 && !load);
    if (rst_i) begin
      full_q1      <= 1'b0;
      next_first_q <= 1'b1;
    end
  end

  // ---- the way is made -----------------------------------------------------------------------------------------------------
  logic full_q, first_q, down_q, aside_q, left, down, step;
  shade_pkg::walked_t run_q;
  shade_pkg::surface_t surface_q;
  logic signed [P_W:0] lines_q, columns_q;
  assign valid_o = full_q && !down_q && !aside_q;
  assign load    = full_q1 && (!full_q || (valid_o && ready_i));
  assign surface_ready_o = load && first_q1;
  assign left    = columns_q[P_W];
  assign down    = load || down_q;
  assign step    = load ? !first_q1 && !lines_q1[P_W] : full_q && (down_q || aside_q);
  always_ff @(posedge clk_i) begin
    if (load) begin
      run_q     <= run_q1;
      first_q   <= first_q1;
      lines_q   <= lines_q1;
      columns_q <= columns_q1;
      down_q    <= !lines_q1[P_W] && lines_q1 != '0;
      aside_q   <= columns_q1 != '0;
    end else if (down_q) begin
      lines_q <= lines_q - (P_W + 1)'(1);
      down_q  <= lines_q != (P_W + 1)'(1);
    end else if (aside_q) begin
      columns_q <= left ? columns_q + (P_W + 1)'(1) : columns_q - (P_W + 1)'(1);
      aside_q   <= left ? columns_q != '1 : columns_q != (P_W + 1)'(1);
    end
    if (surface_ready_o) surface_q <= surface_i;
    full_q <= load || (full_q && !(valid_o && ready_i));
    if (rst_i) full_q <= 1'b0;
  end

  // ---- component by component ------------------------------------------------------------------------------------------------
  logic [COMPONENTS-1:0][S_W-1:0] value_q, first_value, dcolumn, dline;
  assign first_value = surface_i.value;
  assign dcolumn     = surface_q.dcolumn;
  assign dline       = surface_q.dline;
  for (genvar i = 0; i < COMPONENTS; i++) begin : g_component
    logic [S_W-1:0] way;
    assign way = down ? dline[i] : dcolumn[i] ^ {S_W{left}};
    always_ff @(posedge clk_i) begin
      if (surface_ready_o) value_q[i] <= first_value[i];
      else if (step) value_q[i] <= value_q[i] + way + S_W'(!down && left);
    end
  end
  always_comb begin
    begun_o.surface = surface_q;
    begun_o.value   = value_q;
    begun_o.run     = run_q;
    begun_o.first   = first_q;
  end
endmodule
