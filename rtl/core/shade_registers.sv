// SPDX-License-Identifier: Apache-2.0
// shade_registers: the register map of docs/registers.md as an AXI4-Lite slave: settings, status, counters.
//
//   s_axil_*      words of 32 bits, bits 1:0 of an address and *prot are ignored. Address and data of a write may come in any
//                 order; strobes choose its bytes. One access is served at a time; a write and a read that both wait: the write.
//   SLVERR        no register at the offset (reads 0), or a setting written while busy_i: nothing changes.
//                 Allowed while busy: CONTROL with clear set and its settings as they are.
//   draw_o        the settings; they change only while busy_i is 0
//   change_o      high in the last clock of a write: settings may be others in the next one; no span may come in between
//   clear_o       high for one clock: CONTROL.clear was written
//   events_i      STATUS bits to set; they stay until they are cleared
//   counts_i      by how much the counters rise in this clock; CLOCKS rises while busy_i. Counters wrap around.
//                 What comes in the clock of clear_o counts from 0.
//
// DIVIDE = 0, PATH_NORMALS = 0, COLOUR = 0: settings that only the models, the path or the colours left out need are none: they
// read 0, and writing them does nothing.
//
// A read is answered 5 clocks after its address was taken, a write 5 clocks after the later of its address and its data;
// if both wait, the second 4 clocks after the first. No combinational path leads from an input to an output.
// Example: after reset, offset 0x000 reads 0x50534844, "PSHD".
module shade_registers #(
  parameter int DIVIDE       = 1,
  parameter int PATH_NORMALS = 1,
  parameter int COLOUR       = 1
) (
  input  logic               clk_i,
  input  logic               rst_i,
  input  logic               s_axil_awvalid,
  output logic               s_axil_awready,
  input  logic        [11:0] s_axil_awaddr,
  input  logic        [ 2:0] s_axil_awprot,
  input  logic               s_axil_wvalid,
  output logic               s_axil_wready,
  input  logic        [31:0] s_axil_wdata,
  input  logic        [ 3:0] s_axil_wstrb,
  output logic               s_axil_bvalid,
  input  logic               s_axil_bready,
  output logic        [ 1:0] s_axil_bresp,
  input  logic               s_axil_arvalid,
  output logic               s_axil_arready,
  input  logic        [11:0] s_axil_araddr,
  input  logic        [ 2:0] s_axil_arprot,
  output logic               s_axil_rvalid,
  input  logic               s_axil_rready,
  output logic        [31:0] s_axil_rdata,
  output logic        [ 1:0] s_axil_rresp,
  output shade_pkg::draw_t   draw_o,
  output logic               change_o,
  output logic               clear_o,
  input  logic               busy_i,
  input  shade_pkg::status_t events_i,
  input  shade_pkg::counts_t counts_i
);
  if (DIVIDE < 0 || DIVIDE > 1 || PATH_NORMALS < 0 || PATH_NORMALS > 1 || COLOUR < 0 || COLOUR > 1) begin : g_check
    $error("shade_registers: DIVIDE, PATH_NORMALS and COLOUR must be 0 or 1");
  end

  localparam logic [1:0] OKAY = 2'b00;
  localparam logic [1:0] SLVERR = 2'b10;
  localparam logic [11:0] WORD = 12'hffc;  // an address without its byte
  localparam int CLEAR = shade_pkg::REG_CONTROL_CLEAR_LSB;

  // ---- channels: each holds a beat until it is served; not ready means that it does ----------------------------------
  logic write, read;  // an access ends
  logic [11:0] write_at_q, read_at_q;
  logic [31:0] data_q;
  logic [3:0] strobe_q;
  always_ff @(posedge clk_i) begin
    if (s_axil_awready) write_at_q <= s_axil_awaddr & WORD;
    if (s_axil_wready) {strobe_q, data_q} <= {s_axil_wstrb, s_axil_wdata};
    if (s_axil_arready) read_at_q <= s_axil_araddr & WORD;

    if (s_axil_awvalid) s_axil_awready <= 1'b0;
    if (s_axil_wvalid) s_axil_wready <= 1'b0;
    if (s_axil_arvalid) s_axil_arready <= 1'b0;
    if (s_axil_bready) s_axil_bvalid <= 1'b0;
    if (s_axil_rready) s_axil_rvalid <= 1'b0;
    if (write) {s_axil_awready, s_axil_wready, s_axil_bvalid} <= 3'b111;
    if (read) {s_axil_arready, s_axil_rvalid} <= 2'b11;
    if (rst_i) begin
      {s_axil_awready, s_axil_wready, s_axil_arready} <= 3'b111;
      {s_axil_bvalid, s_axil_rvalid}                  <= 2'b00;
    end
  end

  // ---- an access: choose one, read its word, put the bytes written into it, end it ---------------------------------
  logic writable, readable, idle, look_q, merge_q, end_q, write_q;
  shade_pkg::select_t select_q;
  assign writable = !s_axil_awready && !s_axil_wready && !s_axil_bvalid;
  assign readable = !s_axil_arready && !s_axil_rvalid;
  assign idle     = !look_q && !merge_q && !end_q;
  always_ff @(posedge clk_i) begin
    {look_q, merge_q, end_q} <= {idle && (writable || readable), look_q, merge_q};
    if (idle) begin
      write_q  <= writable;  // a read that waits comes next: behind a write no other one can be there yet
      select_q <= shade_pkg::register_at(writable ? write_at_q : read_at_q);
    end
    if (rst_i) {look_q, merge_q, end_q} <= 3'b000;
  end
  assign write    = end_q && write_q;
  assign read     = end_q && !write_q;
  assign change_o = write;

  logic [31:0] draw_q, own_q, word_q, absent;  // own: no setting; absent: bits of CONTROL
  logic [3:0][7:0] data, word, merged;
  logic mapped_q, setting_q, clears_q;
  assign data = data_q;
  assign word = draw_q;  // 0 where it is none of them
  for (genvar i = 0; i < 4; i++) begin : g_byte
    assign merged[i] = write_q && strobe_q[i] ? data[i] : word[i];
  end
  logic own;
  shade_counters u_counters (
    .clk_i, .rst_i, .clear_i(clear_o), .busy_i, .events_i, .counts_i, .select_i(select_q), .own_o(own), .word_o(own_q)
  );
  always_ff @(posedge clk_i) begin
    if (look_q) begin
      mapped_q  <= select_q != '0;
      setting_q <= !own;
      draw_q    <= shade_pkg::draw_word(draw_o, select_q);
    end
    if (merge_q) begin
      word_q   <= merged | own_q;
      clears_q <= select_q.control && ((merged ^ word) & ~absent) == 32'd1 << CLEAR;
    end
  end

  // settings that are there
  logic refused;
  shade_pkg::draw_t built, first, next;
  always_comb begin
    built = '1;
    if (DIVIDE == 0) begin
      built.material.inv_n     = '0;
      built.material.inv_n_exp = '0;
      built.material.f0        = '0;
      built.light.vh           = '0;
    end
    if (PATH_NORMALS == 0) begin
      built.control.path      = '0;
      built.control.variant   = '0;
      built.planner.threshold = '0;
    end
    if (COLOUR == 0) begin
      built.control.colour = '0;
      built.colour         = '0;
    end
  end
  shade_pkg::select_t control;
  always_comb begin
    control         = '0;
    control.control = 1'b1;
  end
  assign absent = shade_pkg::draw_word(~built, control);
  assign first  = shade_pkg::DRAW_RESET & built;
  assign next   = shade_pkg::draw_written(draw_o, select_q, word_q) & built;
  assign refused = !mapped_q || (setting_q && busy_i && !clears_q);
  always_ff @(posedge clk_i) begin
    if (read) {s_axil_rdata, s_axil_rresp} <= {word_q, mapped_q ? OKAY : SLVERR};
    if (write) s_axil_bresp <= refused ? SLVERR : OKAY;
    if (write && !refused) draw_o <= next;
    clear_o <= write && !refused && select_q.control && word_q[CLEAR];
    if (rst_i) begin
      draw_o  <= first;
      clear_o <= 1'b0;
    end
  end

  shade_stable #(.WIDTH(2)) u_write (
    .clk_i, .rst_i, .valid_i(s_axil_bvalid), .ready_i(s_axil_bready), .data_i(s_axil_bresp)
  );
  shade_stable #(.WIDTH(34)) u_read (
    .clk_i, .rst_i, .valid_i(s_axil_rvalid), .ready_i(s_axil_rready), .data_i({s_axil_rresp, s_axil_rdata})
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, s_axil_awaddr, s_axil_araddr, s_axil_awprot, s_axil_arprot};
endmodule
