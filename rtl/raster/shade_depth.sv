// SPDX-License-Identifier: Apache-2.0
// shade_depth: the depth test in front of all shading: of every run only what is nearer than what was drawn before goes on.
//
// surface_i, run_i and surface_o, run_o: as shade_scan gives them. A pixel's depth is value + dcolumn columns + dline lines,
// S1.30, cut to U0.24, from 0 to 1 - 2^-23. It is seen where it is less than the memory's; then it is written there. A run
// becomes as many as it has stretches of pixels that are seen, or none; a triangle without any is left out.
//
//   request_o   a pixel whose depth is asked for          answer_i   its depth, in order, at any latency from one clock on
//   write_o     the new depth of a pixel: always taken, as a write follows an answer, which the memory gives when it
//               likes, within 3 clocks; a request behind it must see it. 1 - 2^-24 stands for a pixel without a triangle
//   end_o       a triangle is through, for one clock
//
// A triangle waits until the one before is answered. A pixel a clock, with up to 2^LOG2 questions open.
// Example: a run of 5 pixels behind one that hides its second: runs of 1 and 3 pixels.
module shade_depth #(
  parameter int LOG2 = 4
) (
  input  logic                          clk_i,
  input  logic                          rst_i,
  input  logic                          surface_valid_i,
  output logic                          surface_ready_o,
  input  shade_pkg::surface_t           surface_i,
  input  logic                          run_valid_i,
  output logic                          run_ready_o,
  input  shade_pkg::walked_t            run_i,
  output logic                          request_valid_o,
  input  logic                          request_ready_i,
  output shade_pkg::site_t              request_o,
  input  logic                          answer_valid_i,
  input  logic [shade_pkg::DEPTH_F-1:0] answer_i,
  output logic                          write_valid_o,
  output shade_pkg::deep_t              write_o,
  output logic                          surface_valid_o,
  input  logic                          surface_ready_i,
  output shade_pkg::surface_t           surface_o,
  output logic                          run_valid_o,
  input  logic                          run_ready_i,
  output shade_pkg::walked_t            run_o,
  output logic                          end_o
);
  if (LOG2 < 2) begin : g_check
    $error("shade_depth: LOG2 must be at least 2");
  end

  localparam int S_W = shade_pkg::STEP_W;
  localparam int Z_W = shade_pkg::DEPTH_F;
  localparam int DROP = shade_pkg::PLANE_F - Z_W;
  localparam int C_W = shade_pkg::COUNT_W;

  // ---- the surface stays in front of this module until a pixel of it is seen, or none was -----------------------------------
  logic held_q, want_q, sent_q, start_taken, drop, emit;
  assign surface_o       = surface_i;
  assign surface_valid_o = want_q;
  assign surface_ready_o = (want_q && surface_ready_i) || drop;
  always_ff @(posedge clk_i) begin
    held_q <= !rst_i && (start_taken || (held_q && !surface_ready_o));
  end

  // ---- a run is walked, pixel by pixel ----------------------------------------------------------------------------------------
  logic begun_valid, begun_ready, walk_q, issue, first_q, single_q, last_q, room_q, free_q;
  shade_pkg::begun_t begun;
  shade_pkg::site_t site_q;
  logic [C_W-1:0] left_q;
  logic [S_W-1:0] z_q, dz_q;
  shade_starts u_starts (
    .clk_i, .rst_i, .surface_valid_i(surface_valid_i && !held_q), .surface_ready_o(start_taken), .surface_i,
    .run_valid_i, .run_ready_o, .run_i, .valid_o(begun_valid), .ready_i(begun_ready), .begun_o(begun)
  );
  assign begun_ready     = !walk_q || (issue && single_q);
  assign request_valid_o = walk_q && room_q && (!first_q || free_q);
  assign request_o       = site_q;
  assign issue           = request_valid_o && request_ready_i;
  always_ff @(posedge clk_i) begin
    if (begun_ready) begin
      site_q   <= {begun.run.line, begun.run.column};
      z_q      <= begun.value.depth;
      dz_q     <= begun.surface.dcolumn.depth;
      left_q   <= begun.run.count - C_W'(1);
      single_q <= begun.run.count == C_W'(1);
      first_q  <= begun.first;
      last_q   <= begun.run.last;
    end else if (issue) begin
      site_q.column <= site_q.column + 1'b1;
      z_q           <= z_q + dz_q;
      left_q        <= left_q - C_W'(1);
      single_q      <= left_q == C_W'(1);
      first_q       <= 1'b0;
    end
    walk_q <= !rst_i && (begun_ready ? begun_valid : walk_q);
  end

  // ---- what waits for its answer ------------------------------------------------------------------------------------------------
  shade_pkg::tested_t asked, tested;
  logic [Z_W-1:0] deep;
  logic too_far, answer_q, waits, unused_taken;
  logic [Z_W-1:0] known_q;
  assign deep    = z_q[DROP+:Z_W];
  assign too_far = z_q[S_W-2] || deep == '1;
  always_comb begin
    asked.deep.site  = site_q;
    asked.deep.depth = z_q[S_W-1] ? '0 : too_far ? Z_W'((1 << Z_W) - 2) : deep;
    asked.ends       = single_q;
    asked.last       = single_q && last_q;
  end
  shade_fifo #(.WIDTH($bits(asked)), .LOG2(LOG2)) u_asked (
    .clk_i, .rst_i, .valid_i(issue), .data_i(asked), .valid_o(waits), .ready_i(answer_q), .data_o(tested),
    .taken_o(unused_taken)
  );
  shade_assert u_answer (.clk_i, .rst_i, .holds_i(!answer_q || waits));

  // ---- stretches of pixels that are seen -----------------------------------------------------------------------------------------
  shade_pkg::tested_t tested_q;
  shade_pkg::walked_t run_new, run_q;
  logic known, seen_q, open_q, any_q, put_q;
  logic [C_W-1:0] count_q, count;
  logic [shade_pkg::PLACE_W-1:0] column_q;
  assign count = open_q ? count_q : '0;
  assign emit  = known && (seen_q ? tested_q.ends : open_q || (tested_q.last && any_q));
  assign drop  = known && tested_q.last && !emit && !any_q;
  always_comb begin
    run_new.column = open_q ? column_q : tested_q.deep.site.column;
    run_new.line   = tested_q.deep.site.line;
    run_new.count  = seen_q ? count + C_W'(1) : count;
    run_new.last   = tested_q.last;
    run_new.none   = !seen_q && !open_q;
  end
  always_ff @(posedge clk_i) begin
    answer_q <= answer_valid_i && !rst_i;
    known_q  <= answer_i;
    known    <= answer_q && !rst_i;
    seen_q   <= tested.deep.depth < known_q;
    tested_q <= tested;
    if (known) begin
      open_q   <= seen_q && !tested_q.ends;
      any_q    <= (any_q || emit) && !tested_q.last;
      column_q <= run_new.column;
      count_q  <= run_new.count;
      run_q    <= run_new;
    end
    put_q         <= emit && !rst_i;
    write_valid_o <= known && seen_q && !rst_i;
    write_o       <= tested_q.deep;
    end_o         <= known && tested_q.last && !rst_i;
    want_q        <= want_q ? !surface_ready_i : emit && !sent_q;
    sent_q        <= sent_q ? !(issue && first_q) : want_q && surface_ready_i;
    if (rst_i) {open_q, any_q, want_q, sent_q} <= '0;
  end

  // ---- room for the runs that the open questions may give ---------------------------------------------------------------------------
  logic [LOG2:0] room, open, room_d, open_d;
  logic known_q2, taken;
  assign room_d = room + (LOG2 + 1)'(taken) + (LOG2 + 1)'(known_q2 && !put_q) - (LOG2 + 1)'(issue);
  assign open_d = open + (LOG2 + 1)'(issue) - (LOG2 + 1)'(known_q2);
  always_ff @(posedge clk_i) begin
    known_q2 <= known && !rst_i;
    room     <= rst_i ? (LOG2 + 1)'(1 << LOG2) : room_d;
    open     <= rst_i ? '0 : open_d;
    room_q   <= rst_i || room_d != '0;
    free_q   <= rst_i || (open_d == '0 && !want_q && !emit);
  end
  shade_fifo #(.WIDTH($bits(run_q)), .LOG2(LOG2)) u_runs (
    .clk_i, .rst_i, .valid_i(put_q), .data_i(run_q), .valid_o(run_valid_o), .ready_i(run_ready_i), .data_o(run_o),
    .taken_o(taken)
  );

  logic unused_begun;
  assign unused_begun = &{1'b0, begun};
endmodule
