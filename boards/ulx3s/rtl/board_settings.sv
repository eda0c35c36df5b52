// SPDX-License-Identifier: Apache-2.0
// board_settings: writes the words of a material into the registers of shade_core, from a table.
//
// Entry 16 choice_i + i of the table, offset and word, up to an offset of FFF. start_i begins; busy_o until the last answer.
// Latency 6 clocks and what the registers take, a word. Example: choice_i = 1 -> entries 16, 17, ...
module board_settings (
  input  logic        clk_i,
  input  logic        rst_i,
  input  logic        start_i,
  input  logic [ 4:0] choice_i,
  output logic        busy_o,
  output logic        awvalid_o,
  input  logic        awready_i,
  output logic        wvalid_o,
  input  logic        wready_i,
  input  logic        bvalid_i,
  output logic [11:0] offset_o,
  output logic [31:0] word_o
);
  logic [43:0] entries[0:511];
  initial $readmemh("settings.hex", entries);
  logic [8:0] at_q;
  logic [1:0] look_q;
  logic waits_q;
  always_ff @(posedge clk_i) begin
    {offset_o, word_o} <= entries[at_q];
    look_q             <= {look_q[0], start_i || (bvalid_i && waits_q)};
    if (start_i) begin
      at_q   <= {choice_i, 4'd0};
      busy_o <= 1'b1;
    end
    if (look_q[1]) begin
      if (offset_o == 12'hfff) busy_o <= 1'b0;
      else {awvalid_o, wvalid_o, waits_q} <= 3'b111;
    end
    if (awvalid_o && awready_i) awvalid_o <= 1'b0;
    if (wvalid_o && wready_i) wvalid_o <= 1'b0;
    if (bvalid_i && waits_q) begin
      waits_q <= 1'b0;
      at_q    <= at_q + 9'd1;
    end
    if (rst_i) {busy_o, awvalid_o, wvalid_o, waits_q, look_q} <= '0;
  end
endmodule
