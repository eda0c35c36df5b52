// SPDX-License-Identifier: Apache-2.0
// shade_direct: light at every pixel of triangles, from scalars that additions step: no normal, no root of a vector.
//
//   packet ─▶ door ─▶ setup ─▶ line ─▶ shade_fifo ─▶ run ─▶ light ─▶ shade_fifo ─▶ m_axis_pixel
//                └──▶ runs ─▶ moves ─┘
//
//   s_axis_surface  triangle_t in four beats, then its runs, a run_t a beat, tlast with the last: see docs/interface.md;
//                   or lobe_t and entries of the table of the lobe, which waits until all pixels before it are drawn
//   m_axis_pixel    tdata = {specular, diffuse}, U0.16; tuser = the triangle's tag; tlast = last pixel of a run
//   l_i, h_i        directions to the light and half way to the viewer, S1.16; they must not change while a pixel is inside
//   busy_o          runs are inside
//   error_o         sticky: DIRECT_EMPTY, _LONG, _PACKET, _ORDER, of runs and packets that are dropped, and _SHORT, _LARGE:
//                   a pixel's normal was shorter than 1/2, longer than 1; error_count_o: what was dropped
//
// One directional light, a viewer at infinity. Products: 36 for each triangle by three multipliers, 5 at a pixel.
// One pixel a clock while runs are long enough: a run costs 1 clock + its moves, a triangle 12 clocks, both beside the
// drawing of others. No path leads from an input to an output but from tready's state. Latency 36 clocks and a few from
// the last vector of a triangle to its first pixel. Example: n = L = H = (0, 0, 1), a run of 5 pixels -> five of full light.
module shade_direct (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  shade_pkg::vec_t                      l_i,
  input  shade_pkg::vec_t                      h_i,
  input  logic                                 s_axis_surface_tvalid,
  output logic                                 s_axis_surface_tready,
  input  logic [shade_pkg::SURFACE_DATA_W-1:0] s_axis_surface_tdata,
  input  logic                                 s_axis_surface_tlast,
  output logic                                 m_axis_pixel_tvalid,
  input  logic                                 m_axis_pixel_tready,
  output logic [  shade_pkg::PIXEL_DATA_W-1:0] m_axis_pixel_tdata,
  output logic [         shade_pkg::TAG_W-1:0] m_axis_pixel_tuser,
  output logic                                 m_axis_pixel_tlast,
  output logic                                 busy_o,
  output logic [shade_pkg::DIRECT_ERROR_W-1:0] error_o,
  output logic [                         15:0] error_count_o
);
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int RUNS_LOG2 = shade_pkg::DIRECT_RUNS_LOG2;
  localparam int STARTS_LOG2 = shade_pkg::DIRECT_STARTS_LOG2;
  localparam int FIFO_LOG2 = shade_pkg::DIRECT_FIFO_LOG2;
  localparam int INSIDE_W = 8;  // runs inside: at most 64 that wait as runs, as starts, as pixels each, some between

  // ---- packets ------------------------------------------------------------------------------------------------------
  logic vector_valid, vector_ready, wide, tall, cut, write, packet_error;
  logic [1:0] kind;
  shade_pkg::growth_t vector;
  logic [shade_pkg::CHORD_INDEX_W-1:0] address;
  shade_pkg::chord_t chord;
  logic [shade_pkg::CHORD_SHIFT_W-1:0] shift;
  logic signed [shade_pkg::EXCESS_W-1:0] excess;
  logic run_in_valid, run_taken, run_valid, run_ready;
  shade_pkg::waiting_t run_in, run;
  shade_direct_door u_door (
    .clk_i, .rst_i, .s_axis_surface_tvalid, .s_axis_surface_tready, .s_axis_surface_tdata, .s_axis_surface_tlast,
    .vector_valid_o(vector_valid), .vector_ready_i(vector_ready), .vector_o(vector), .kind_o(kind), .wide_o(wide),
    .tall_o(tall), .cut_o(cut), .run_valid_o(run_in_valid), .run_o(run_in), .credit_i(run_taken), .idle_i(!busy_o),
    .write_o(write), .address_o(address), .chord_o(chord), .shift_o(shift), .excess_o(excess), .error_o(packet_error)
  );
  shade_fifo #(.WIDTH($bits(run_in)), .LOG2(RUNS_LOG2), .BLOCK(1)) u_runs (
    .clk_i, .rst_i, .valid_i(run_in_valid), .data_i(run_in), .valid_o(run_valid), .ready_i(run_ready), .data_o(run),
    .taken_o(run_taken)
  );

  // ---- scalars: of a triangle, of a run, of a pixel --------------------------------------------------------------------
  logic full, next, moves_valid, moves_ready, empty_error, long_error, order_error, dropped;
  shade_pkg::coefficients_t coefficients;
  shade_pkg::moves_t moves;
  shade_direct_setup u_setup (
    .clk_i, .rst_i, .l_i, .h_i, .valid_i(vector_valid), .ready_o(vector_ready), .vector_i(vector), .kind_i(kind),
    .wide_i(wide), .tall_i(tall), .cut_i(cut), .valid_o(full), .ready_i(next), .coefficients_o(coefficients)
  );
  shade_direct_moves u_moves (
    .clk_i, .rst_i, .valid_i(run_valid), .ready_o(run_ready), .run_i(run), .valid_o(moves_valid),
    .ready_i(moves_ready), .moves_o(moves), .empty_o(empty_error), .long_o(long_error), .order_o(order_error)
  );
  logic made_valid, start_valid, start_ready, start_taken;
  shade_pkg::start_t made, start;
  shade_direct_line #(.LOG2(STARTS_LOG2)) u_line (
    .clk_i, .rst_i, .valid_i(moves_valid), .ready_o(moves_ready), .moves_i(moves), .full_i(full), .next_o(next),
    .coefficients_i(coefficients), .start_valid_o(made_valid), .start_o(made), .credit_i(start_taken),
    .dropped_o(dropped)
  );
  shade_fifo #(.WIDTH($bits(made)), .LOG2(STARTS_LOG2), .BLOCK(1)) u_starts (
    .clk_i, .rst_i, .valid_i(made_valid), .data_i(made), .valid_o(start_valid), .ready_i(start_ready), .data_o(start),
    .taken_o(start_taken)
  );
  logic credit, issue, last;
  logic [TAG_W-1:0] tag;
  shade_pkg::scalars_t scalars;
  shade_direct_run #(.FIFO_LOG2(FIFO_LOG2)) u_run (
    .clk_i, .rst_i, .valid_i(start_valid), .ready_o(start_ready), .start_i(start), .credit_i(credit),
    .valid_o(issue), .scalars_o(scalars), .last_o(last), .tag_o(tag)
  );

  // ---- light, pixels ----------------------------------------------------------------------------------------------------
  logic lit, short, long;
  shade_pkg::pixel_t pixel;
  shade_direct_light u_light (
    .clk_i, .write_i(write), .address_i(address), .chord_i(chord), .shift_i(shift), .excess_i(excess),
    .scalars_i(scalars), .pixel_o(pixel), .short_o(short), .long_o(long)
  );
  shade_valid #(.DEPTH(shade_pkg::LATENCY_DIRECT_LIGHT)) u_valid (
    .clk_i, .rst_i, .valid_i(issue), .valid_o(lit)
  );
  shade_fifo #(.WIDTH(shade_pkg::PIXEL_DATA_W), .LOG2(FIFO_LOG2), .BLOCK(1)) u_pixels (
    .clk_i, .rst_i, .valid_i(lit), .data_i(pixel), .valid_o(m_axis_pixel_tvalid), .ready_i(m_axis_pixel_tready),
    .data_o(m_axis_pixel_tdata), .taken_o(credit)
  );
  // what needs no computing is there long before its pixel, and leaves with it; deep enough for a block RAM
  logic tag_valid, tag_taken;
  shade_fifo #(.WIDTH(1 + TAG_W), .LOG2(FIFO_LOG2 + 1), .BLOCK(1)) u_tags (
    .clk_i, .rst_i, .valid_i(issue), .data_i({last, tag}), .valid_o(tag_valid),
    .ready_i(m_axis_pixel_tvalid && m_axis_pixel_tready), .data_o({m_axis_pixel_tlast, m_axis_pixel_tuser}),
    .taken_o(tag_taken)
  );

  // ---- is anything inside, what went wrong -------------------------------------------------------------------------------
  // a run is inside until it is dropped or its last pixel is taken
  logic [INSIDE_W-1:0] inside_q;
  logic over, run_error;
  assign over      = m_axis_pixel_tvalid && m_axis_pixel_tready && m_axis_pixel_tlast;
  assign busy_o    = inside_q != '0;
  assign run_error = empty_error || long_error || order_error;
  always_ff @(posedge clk_i) begin
    inside_q <= inside_q + INSIDE_W'(run_in_valid) - INSIDE_W'(over) - INSIDE_W'(dropped);
    error_o  <= error_o | {lit && long, lit && short, order_error, packet_error, long_error, empty_error};
    if (!(&error_count_o[15:1])) begin
      error_count_o <= error_count_o + {14'd0, run_error && packet_error, run_error != packet_error};
    end
    if (rst_i) begin
      inside_q      <= '0;
      error_o       <= '0;
      error_count_o <= '0;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, tag_valid, tag_taken};
endmodule
