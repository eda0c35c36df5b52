// SPDX-License-Identifier: Apache-2.0
// shade_widen: words of a narrow AXI4-Stream put together to wide beats: a bus of 32 or 64 bits in front of s_axis_span.
//
// The first word of a beat stands at the bottom. A packet that ends within a beat ends it: the rest has tkeep = 0, which
// shade_core tells as a packet cut short. tlast of a beat is that of its last word.
// IN_W divides OUT_W. A beat takes OUT_W / IN_W clocks and one more; latency 1 clock from its last word. No combinational path
// leads from an input to an output. Example: IN_W = 64, words 1, 2, 3, 4, the last with tlast -> 4 2^192 + 3 2^128 + 2 2^64 + 1.
module shade_widen #(
  parameter int IN_W  = 32,
  parameter int OUT_W = shade_pkg::SPAN_DATA_W
) (
  input  logic               clk_i,
  input  logic               rst_i,
  input  logic               s_axis_word_tvalid,
  output logic               s_axis_word_tready,
  input  logic [   IN_W-1:0] s_axis_word_tdata,
  input  logic               s_axis_word_tlast,
  output logic               m_axis_beat_tvalid,
  input  logic               m_axis_beat_tready,
  output logic [  OUT_W-1:0] m_axis_beat_tdata,
  output logic [OUT_W/8-1:0] m_axis_beat_tkeep,
  output logic               m_axis_beat_tlast
);
  if (IN_W < 8 || IN_W % 8 != 0 || OUT_W <= IN_W || OUT_W % IN_W != 0) begin : g_check
    $error("shade_widen: IN_W must be whole bytes and less than OUT_W, of which it is a divisor");
  end

  localparam int WORDS = OUT_W / IN_W;
  logic [WORDS-1:0] place_q;  // of the next word, a bit
  logic take, ends;
  assign s_axis_word_tready = !m_axis_beat_tvalid;
  assign take               = s_axis_word_tvalid && s_axis_word_tready;
  assign ends               = take && (place_q[WORDS-1] || s_axis_word_tlast);
  for (genvar i = 0; i < WORDS; i++) begin : g_word
    always_ff @(posedge clk_i) begin
      if (take && (place_q[0] || place_q[i])) begin
        m_axis_beat_tdata[i*IN_W+:IN_W]     <= place_q[i] ? s_axis_word_tdata : '0;
        m_axis_beat_tkeep[i*IN_W/8+:IN_W/8] <= {(IN_W / 8) {place_q[i]}};
      end
    end
  end
  always_ff @(posedge clk_i) begin
    if (take) begin
      place_q           <= ends ? WORDS'(1) : place_q << 1;
      m_axis_beat_tlast <= s_axis_word_tlast;
    end
    m_axis_beat_tvalid <= m_axis_beat_tvalid ? !m_axis_beat_tready : ends;
    if (rst_i) begin
      place_q            <= WORDS'(1);
      m_axis_beat_tvalid <= 1'b0;
    end
  end
  shade_stable #(.WIDTH(OUT_W + 1)) u_stable (
    .clk_i, .rst_i, .valid_i(m_axis_beat_tvalid), .ready_i(m_axis_beat_tready),
    .data_i({m_axis_beat_tlast, m_axis_beat_tdata})
  );
endmodule
