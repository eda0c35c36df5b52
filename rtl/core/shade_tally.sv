// SPDX-License-Identifier: Apache-2.0
// shade_tally: what the lanes did in a clock, summed up for the registers.
//
//   valid_i, ready_i   of every lane's pixel
//   lit_i, flags_i     light of a point is done, and what is to be told of it, of every lane
//   given_o            a lane gives a pixel in this clock
//   pixels_o           pixels given; stalls_o: pixels that wait; evaluations_o: points lit
//   flags_o            all that was told
//
// Exact. Latency 1 clock, pixels_o and stalls_o 2 clocks; one set of inputs a clock.
// Example: two lanes, both give a pixel, one is not taken -> pixels_o = 1, stalls_o = 1.
module shade_tally #(
  parameter int LANES = 1
) (
  input  logic                                              clk_i,
  input  logic                                              rst_i,
  input  logic [LANES-1:0]                                  valid_i,
  input  logic [LANES-1:0]                                  ready_i,
  input  logic [LANES-1:0]                                  lit_i,
  input  logic [LANES-1:0][shade_pkg::NODE_FLAGS_BITS-1:0] flags_i,
  output logic [LANES-1:0]                                  given_o,
  output logic [2:0]                                        pixels_o,
  output logic [2:0]                                        stalls_o,
  output logic [2:0]                                        evaluations_o,
  output shade_pkg::node_flags_t                            flags_o
);
  if (LANES < 1 || LANES > 7) begin : g_check
    $error("shade_tally: LANES must be in 1 .. 7");
  end

  logic [LANES-1:0] out_q, stall_q;
  logic [2:0] pixels, stalls, evaluations;
  logic [shade_pkg::NODE_FLAGS_BITS-1:0] flags, flags_q;
  assign given_o = valid_i & ready_i;
  always_comb begin
    {pixels, stalls, evaluations} = '0;
    flags                         = '0;
    for (int i = 0; i < LANES; i++) begin
      pixels      = pixels + 3'(out_q[i]);
      stalls      = stalls + 3'(stall_q[i]);
      evaluations = evaluations + 3'(lit_i[i]);
      if (lit_i[i]) flags = flags | flags_i[i];
    end
  end
  assign flags_o  = flags_q;
  always_ff @(posedge clk_i) begin
    out_q         <= given_o;
    stall_q       <= valid_i & ~ready_i;
    pixels_o      <= pixels;
    stalls_o      <= stalls;
    evaluations_o <= evaluations;
    flags_q       <= flags;
    if (rst_i) {out_q, stall_q, pixels_o, stalls_o, evaluations_o, flags_q} <= '0;
  end
endmodule
