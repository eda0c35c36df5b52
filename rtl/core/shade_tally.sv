// SPDX-License-Identifier: Apache-2.0
// shade_tally: what door and lanes did in a clock, summed up for the registers.
//
//   given_i, held_i    a lane gives a pixel in this clock; its pixel waits
//   lit_i, flags_i     light of a point is done, and what is to be told of it, of every lane
//   told_i             by the door, of a packet
//   counts_o           pixels given; stalls: pixels that wait; evaluations: points lit; spans and errors of the door
//   events_o           all that was told, of points and of packets
//
// Exact. Latency 1 clock, of pixels and stalls 2 clocks, of told_i none; one set of inputs a clock.
// Example: two lanes, both give a pixel, one is not taken -> counts_o.pixels = 1, counts_o.stalls = 1.
module shade_tally #(
  parameter int LANES = 1
) (
  input  logic                                             clk_i,
  input  logic                                             rst_i,
  input  logic [LANES-1:0]                                 given_i,
  input  logic [LANES-1:0]                                 held_i,
  input  logic [LANES-1:0]                                 lit_i,
  input  logic [LANES-1:0][shade_pkg::NODE_FLAGS_BITS-1:0] flags_i,
  input  shade_pkg::told_t                                 told_i,
  output shade_pkg::counts_t                               counts_o,
  output shade_pkg::status_t                               events_o
);
  if (LANES < 1 || LANES > 7) begin : g_check
    $error("shade_tally: LANES must be in 1 .. 7");
  end

  localparam int FLAGS_W = shade_pkg::NODE_FLAGS_BITS;
  logic [LANES-1:0] given_q, held_q;
  logic [2:0] pixels, stalls, evaluations, pixels_q, stalls_q, evaluations_q;
  logic [FLAGS_W-1:0] flags, flags_q;
  always_comb begin
    {pixels, stalls, evaluations} = '0;
    flags                         = '0;
    for (int i = 0; i < LANES; i++) begin
      pixels      = pixels + 3'(given_q[i]);
      stalls      = stalls + 3'(held_q[i]);
      evaluations = evaluations + 3'(lit_i[i]);
      if (lit_i[i]) flags = flags | flags_i[i];
    end
  end
  always_ff @(posedge clk_i) begin
    given_q       <= given_i;
    held_q        <= held_i;
    pixels_q      <= pixels;
    stalls_q      <= stalls;
    evaluations_q <= evaluations;
    flags_q       <= flags;
    if (rst_i) {given_q, held_q, pixels_q, stalls_q, evaluations_q, flags_q} <= '0;
  end
  assign counts_o.pixels      = pixels_q;
  assign counts_o.stalls      = stalls_q;
  assign counts_o.evaluations = evaluations_q;
  assign counts_o.spans       = 3'(told_i.good);
  assign counts_o.errors      = 3'(told_i.bad);
  assign events_o.node        = flags_q;
  assign events_o.error       = told_i.error;
endmodule
