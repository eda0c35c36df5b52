// SPDX-License-Identifier: Apache-2.0
// shade_packets: triangles and their runs to packets TRIANGLE and RUN, which shade_direct and shade_patch take.
//
// begun_i: see shade_starts. A packet begins with four beats: box, normal at the surface's pixel, increments per column
// and line; a run a beat follows, tlast with the last. Where the first run begins elsewhere, because what was before it is
// hidden, an empty run at the surface's pixel comes before it. An increment is a mantissa S1.16 times 2^-exp, exp 0 to 15 as large as
// fits, to nearest, ties up. What is too steep for the triangle's box becomes a packet a run: an
// increment of the normal, times the largest power of two below the box's size, outside of [-2, 2); a second run on a
// line begins a packet, too: an empty run ends the one before.
//
// run_o: this beat is a run with pixels. Clocks: 19 a packet, 1 a run. No path from tready to an output but ready_o.
// Example: an increment of 2^-4 per column -> exp 4, mantissa 2^16, that is 1.
module shade_packets (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  logic                                 valid_i,
  output logic                                 ready_o,
  input  shade_pkg::begun_t                    begun_i,
  output logic                                 m_axis_surface_tvalid,
  input  logic                                 m_axis_surface_tready,
  output logic [shade_pkg::SURFACE_DATA_W-1:0] m_axis_surface_tdata,
  output logic                                 m_axis_surface_tlast,
  output logic                                 run_o
);
  localparam int S_W = shade_pkg::STEP_W;
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int DROP = shade_pkg::STEP_F - shade_pkg::INTENSITY_F;
  localparam int P_W = shade_pkg::PLACE_W;
  localparam int C_W = shade_pkg::COUNT_W;

  shade_pkg::walked_t run;
  shade_pkg::surface_t surface;
  assign run     = begun_i.run;
  assign surface = begun_i.surface;

  // ---- does a triangle fit a packet: two clocks with its first run ---------------------------------------------------------
  logic narrow_q;
  logic [1:0] looked_q;
  logic [C_W-1:0] last_column, last_line, column_mask_q, line_mask_q;
  assign last_column = surface.columns - C_W'(1);
  assign last_line   = surface.lines - C_W'(1);
  function automatic logic over(input shade_pkg::step_t g, input logic [C_W-1:0] mask);
    over = 1'b0;
    for (int i = 0; i < C_W; i++) begin
      if (mask[i] && (g.x[S_W-2-i] != g.x[S_W-1] || g.y[S_W-2-i] != g.y[S_W-1] || g.z[S_W-2-i] != g.z[S_W-1])) over = 1'b1;
    end
  endfunction
  always_ff @(posedge clk_i) begin
    for (int i = 0; i < C_W; i++) begin
      column_mask_q[i] <= i == 0 || (last_column >> i) != '0;
      line_mask_q[i]   <= i == 0 || (last_line >> i) != '0;
    end
    if (!looked_q[1]) narrow_q <= !surface.steep && !over(surface.dcolumn.normal, column_mask_q) && !over(surface.dline.normal, line_mask_q);
    if (rst_i || (valid_i && ready_o && run.last)) looked_q <= '0;
    else if (valid_i) looked_q <= {looked_q[0], 1'b1};
  end

  // ---- what comes next: a run, its head before it, or an empty run -------------------------------------------------------
  typedef enum logic [2:0] {WAIT, RUN, BOX, VECTOR, SITE} state_e;
  state_e state_q;
  logic open_q, sent_q, end_q, step, last, moved;  // sent: the open packet has a run; end: the beat is an empty run
  logic [P_W-1:0] line_q;
  logic [1:0] vector_q;  // normal, per column, per line
  logic [3:0] shift_q;  // by 8, 4, 2, 1
  assign step    = m_axis_surface_tvalid && m_axis_surface_tready;
  assign ready_o = (state_q == RUN && step && !(end_q && !run.none)) || (state_q == WAIT && looked_q[1] && run.none && !open_q);
  assign last    = end_q || run.last || !narrow_q;
  assign moved   = narrow_q && {run.line, run.column} != surface.site;
  assign m_axis_surface_tvalid = state_q == VECTOR ? shift_q == '0 : state_q != WAIT;
  assign m_axis_surface_tlast  = state_q == RUN && last;
  assign run_o                 = state_q == RUN && !end_q;
  always_ff @(posedge clk_i) begin
    case (state_q)
      WAIT: if (valid_i && looked_q[1]) begin
        end_q <= run.none || (open_q && sent_q && run.line == line_q);
        if (open_q) state_q <= RUN;
        else if (!run.none) state_q <= BOX;
      end
      BOX: if (step) begin
        state_q  <= VECTOR;
        vector_q <= 2'd0;
      end
      VECTOR: if (step) begin
        vector_q <= vector_q + 2'd1;
        open_q   <= vector_q == 2'd2;
        sent_q   <= 1'b0;
        end_q    <= 1'b0;
        if (vector_q == 2'd2) state_q <= moved ? SITE : RUN;
      end
      SITE: if (step) state_q <= RUN;
      default: if (step) begin
        state_q <= WAIT;
        open_q  <= !last;
        sent_q  <= 1'b1;
        line_q  <= run.line;
      end
    endcase
    if (rst_i) begin
      state_q <= WAIT;
      open_q  <= 1'b0;
    end
  end

  // ---- the head: a box, three vectors; an increment moves up as far as it fits --------------------------------------------
  logic [2:0][S_W-1:0] vector, x_q;
  logic [3:0] exp_q, next_shift;
  logic load, wide, tall, room;
  assign load = (state_q == BOX || state_q == VECTOR) && step;
  assign wide = narrow_q ? surface.columns != C_W'(1) : run.count != C_W'(1);
  assign tall = narrow_q && surface.lines != C_W'(1);
  assign next_shift = state_q == BOX ? 4'd0 : 4'd8;
  always_comb begin
    if (state_q == BOX) vector = narrow_q ? surface.value.normal : begun_i.value.normal;
    else if (vector_q == 2'd0) vector = wide ? surface.dcolumn.normal : '0;
    else vector = tall ? surface.dline.normal : '0;
    room = 1'b1;  // all components have their sign in more bits than they move up by
    for (int i = 0; i < 3; i++) begin
      for (int j = 1; j < 10; j++) if (j <= int'(shift_q) + 1 && x_q[i][S_W-1-j] != x_q[i][S_W-1]) room = 1'b0;
    end
  end
  always_ff @(posedge clk_i) begin
    if (load) begin
      x_q     <= vector;
      exp_q   <= '0;
      shift_q <= next_shift;
    end else if (state_q == VECTOR) begin
      if (room) begin
        exp_q <= exp_q | shift_q;
        for (int i = 0; i < 3; i++) x_q[i] <= x_q[i] << shift_q;
      end
      shift_q <= shift_q >> 1;
    end
  end

  // ---- beats ------------------------------------------------------------------------------------------------------------------
  shade_pkg::growth_t growth;
  logic [2:0][W-1:0] rounded;
  for (genvar i = 0; i < 3; i++) begin : g_round
    logic signed [S_W-DROP:0] all;
    shade_round #(.WIDTH(S_W), .DROP(DROP)) u_round (.x_i(x_q[i]), .y_o(all));
    shade_limit #(.WIDTH(S_W - DROP + 1)) u_limit (.x_i(all), .y_o(rounded[i]));
  end
  assign growth.mantissa = rounded;
  assign growth.exp      = exp_q;
  assign growth.unused_58 = '0;
  logic [3:0][15:0] box;
  assign box[0] = 16'(narrow_q ? surface.columns : run.count);
  assign box[1] = 16'(narrow_q ? surface.lines : C_W'(1));
  assign box[2] = {3'd0, surface.flat, narrow_q ? surface.left : P_W'(0)};
  assign box[3] = surface.tag;
  always_comb begin
    case (state_q)
      BOX: m_axis_surface_tdata = box;
      VECTOR: m_axis_surface_tdata = growth;
      SITE: m_axis_surface_tdata = {32'd0, 16'(surface.site.line), 16'(surface.site.column)};
      default: m_axis_surface_tdata = end_q ? '0 : {32'(run.count), 16'(run.line), 16'(run.column)};
    endcase
  end

  logic unused_begun;
  assign unused_begun = &{1'b0, begun_i};
endmodule
