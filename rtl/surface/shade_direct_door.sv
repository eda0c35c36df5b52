// SPDX-License-Identifier: Apache-2.0
// shade_direct_door: takes packets of triangles and runs apart; fills the table of the lobe.
//
//   s_axis_surface_*  triangle_t in four beats, then a run_t a beat, tlast with the last run; or lobe_t, then entries
//   vector_*          normal, dcolumn, dline, one after the other; kind_o tells which one is expected: 0, 1, 2
//   wide_o, tall_o    the box has more than one column, line: else that increment is 0, whatever its vector says
//   cut_o             the packet ended before its first run: its vectors count for nothing
//   run_valid_o       a run into a FIFO of 2^LOG2 words; credit_i: one left it
//   write_o, ...      an entry of the table; shift_o, excess_o with it. A packet of the lobe waits until idle_i
//   error_o           a packet cut short, for one clock
//
// Latency 0 clocks, a beat a clock, as long as vectors are taken and runs have credits. No path leads from an input to tready but from
// vector_ready_i. Example: packet of beats box, normal, dcolumn, dline, run, run -> vectors 0, 1, 2; runs first, last.
module shade_direct_door #(
  parameter int LOG2 = shade_pkg::DIRECT_RUNS_LOG2
) (
  input  logic                                       clk_i,
  input  logic                                       rst_i,
  input  logic                                       s_axis_surface_tvalid,
  output logic                                       s_axis_surface_tready,
  input  logic        [shade_pkg::SURFACE_DATA_W-1:0] s_axis_surface_tdata,
  input  logic                                       s_axis_surface_tlast,
  output logic                                       vector_valid_o,
  input  logic                                       vector_ready_i,
  output shade_pkg::growth_t                         vector_o,
  output logic        [1:0]                          kind_o,
  output logic                                       wide_o,
  output logic                                       tall_o,
  output logic                                       cut_o,
  output logic                                       run_valid_o,
  output shade_pkg::waiting_t                        run_o,
  input  logic                                       credit_i,
  input  logic                                       idle_i,
  output logic                                       write_o,
  output logic        [shade_pkg::CHORD_INDEX_W-1:0] address_o,
  output shade_pkg::chord_t                          chord_o,
  output logic        [shade_pkg::CHORD_SHIFT_W-1:0] shift_o,
  output logic signed [shade_pkg::EXCESS_W-1:0]      excess_o,
  output logic                                       error_o
);
  if (LOG2 < 1) begin : g_check
    $error("shade_direct_door: LOG2 must be at least 1");
  end

  typedef enum logic [2:0] {BOX, NORMAL, DCOLUMN, DLINE, RUNS, WAIT, TABLE} state_t;
  state_t state_q;
  logic vector, take, some_credit_q;
  assign vector = state_q == NORMAL || state_q == DCOLUMN || state_q == DLINE;
  assign kind_o = 2'(state_q) - 2'd1;
  always_comb begin
    s_axis_surface_tready = state_q == BOX || state_q == TABLE;
    if (vector) s_axis_surface_tready = vector_ready_i;
    if (state_q == RUNS) s_axis_surface_tready = some_credit_q;
  end
  assign take = s_axis_surface_tvalid && s_axis_surface_tready;

  // ---- triangles --------------------------------------------------------------------------------------------------
  shade_pkg::lobe_t lobe;
  shade_pkg::run_t run;
  logic [shade_pkg::TAG_W-1:0] tag_q;
  logic first_q;
  assign lobe           = s_axis_surface_tdata;
  assign run            = s_axis_surface_tdata;
  assign vector_o       = s_axis_surface_tdata;
  assign vector_valid_o = s_axis_surface_tvalid && vector && !s_axis_surface_tlast;
  assign cut_o          = take && vector && s_axis_surface_tlast;
  assign run_valid_o    = take && state_q == RUNS;
  assign run_o          = {tag_q, s_axis_surface_tlast, first_q, run.count, run.line, run.column};

  // ---- table of the lobe --------------------------------------------------------------------------------------------
  shade_pkg::lobe_t lobe_q;
  logic only_q;  // a head without entries
  assign chord_o = s_axis_surface_tdata[$bits(chord_o)-1:0];
  assign write_o = take && state_q == TABLE;

  localparam int COUNT_W = shade_pkg::COUNT_W;
  always_ff @(posedge clk_i) begin
    if (take && state_q == BOX) begin
      tag_q   <= s_axis_surface_tdata[48+:shade_pkg::TAG_W];
      wide_o  <= s_axis_surface_tdata[0+:COUNT_W] != COUNT_W'(1);
      tall_o  <= s_axis_surface_tdata[16+:COUNT_W] != COUNT_W'(1);
      lobe_q  <= lobe;
      only_q  <= s_axis_surface_tlast;
      first_q <= 1'b1;
    end
    if (run_valid_o) first_q <= 1'b0;
    if (state_q == WAIT && idle_i) begin
      address_o <= '0;
      shift_o   <= lobe_q.shift;
      excess_o  <= lobe_q.excess;
    end else if (write_o) address_o <= address_o + 1'b1;
  end

  // ---- state and credits ----------------------------------------------------------------------------------------------
  logic [LOG2:0] credit_q, credit_d;
  assign credit_d = credit_q + (LOG2 + 1)'(credit_i) - (LOG2 + 1)'(run_valid_o);
  always_ff @(posedge clk_i) begin
    credit_q      <= credit_d;
    some_credit_q <= credit_d != '0;
    error_o       <= cut_o || (take && state_q == BOX && s_axis_surface_tlast && !lobe.lobe);
    case (state_q)
      BOX:
      if (take) begin
        if (lobe.lobe) state_q <= WAIT;
        else if (!s_axis_surface_tlast) state_q <= NORMAL;
      end
      NORMAL: if (take) state_q <= s_axis_surface_tlast ? BOX : DCOLUMN;
      DCOLUMN: if (take) state_q <= s_axis_surface_tlast ? BOX : DLINE;
      DLINE: if (take) state_q <= s_axis_surface_tlast ? BOX : RUNS;
      WAIT: if (idle_i) state_q <= only_q ? BOX : TABLE;
      default: if (take && s_axis_surface_tlast) state_q <= BOX;
    endcase
    if (rst_i) begin
      state_q       <= BOX;
      credit_q      <= (LOG2 + 1)'(1 << LOG2);
      some_credit_q <= 1'b1;
      error_o       <= 1'b0;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, run, lobe_q};
endmodule
