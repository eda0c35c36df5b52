// SPDX-License-Identifier: Apache-2.0
// formal_registers: shade_registers answers every access once, in time, and changes no setting while the core is busy.
module formal_registers (
  input logic        clk_i,
  input logic        rst_i,
  input logic        awvalid_i,
  input logic [11:0] awaddr_i,
  input logic        wvalid_i,
  input logic [31:0] wdata_i,
  input logic [ 3:0] wstrb_i,
  input logic        bready_i,
  input logic        arvalid_i,
  input logic [11:0] araddr_i,
  input logic        rready_i,
  input logic        busy_i
);
  localparam int ALONE = 5;  // clocks to an answer
  localparam int BEHIND = ALONE + 4;  // if the other kind of access is served first

  logic awready, wready, bvalid, arready, rvalid, change, clear;
  logic [1:0] bresp, rresp;
  logic [31:0] rdata;
  shade_pkg::draw_t draw;
  shade_registers u_dut (
    .clk_i, .rst_i, .s_axil_awvalid(awvalid_i), .s_axil_awready(awready), .s_axil_awaddr(awaddr_i),
    .s_axil_awprot(3'd0), .s_axil_wvalid(wvalid_i), .s_axil_wready(wready), .s_axil_wdata(wdata_i),
    .s_axil_wstrb(wstrb_i), .s_axil_bvalid(bvalid), .s_axil_bready(bready_i), .s_axil_bresp(bresp),
    .s_axil_arvalid(arvalid_i), .s_axil_arready(arready), .s_axil_araddr(araddr_i), .s_axil_arprot(3'd0),
    .s_axil_rvalid(rvalid), .s_axil_rready(rready_i), .s_axil_rdata(rdata), .s_axil_rresp(rresp), .draw_o(draw),
    .change_o(change), .clear_o(clear), .busy_i, .events_i('0), .counts_i('0)
  );

  logic started_q = 1'b0;
  logic b_held_q, r_held_q, busy_q, change_q, reset_q;
  logic [1:0] b_resp_q, r_resp_q, aw_owed_q, w_owed_q, ar_owed_q;
  logic [31:0] r_data_q;
  logic [3:0] b_wait_q, r_wait_q;
  shade_pkg::draw_t draw_q;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    reset_q   <= rst_i;
    {b_held_q, b_resp_q} <= {bvalid && !bready_i, bresp};
    {r_held_q, r_resp_q, r_data_q} <= {rvalid && !rready_i, rresp, rdata};
    {draw_q, busy_q, change_q} <= {draw, busy_i, change};
    aw_owed_q <= aw_owed_q + 2'(awvalid_i && awready) - 2'(bvalid && bready_i);
    w_owed_q  <= w_owed_q + 2'(wvalid_i && wready) - 2'(bvalid && bready_i);
    ar_owed_q <= ar_owed_q + 2'(arvalid_i && arready) - 2'(rvalid && rready_i);
    b_wait_q  <= aw_owed_q != '0 && w_owed_q != '0 && !bvalid ? b_wait_q + 4'd1 : 4'd0;
    r_wait_q  <= ar_owed_q != '0 && !rvalid ? r_wait_q + 4'd1 : 4'd0;
    if (rst_i) begin
      {b_held_q, r_held_q, change_q} <= '0;
      {aw_owed_q, w_owed_q, ar_owed_q, b_wait_q, r_wait_q} <= '0;
    end
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // An answer that waits stays as it is.
      // mutant: if (s_axil_bready) s_axil_bvalid <= 1'b0 => s_axil_bvalid <= 1'b0
      b_stable : assert (!b_held_q || (bvalid && bresp == b_resp_q));
      // mutant: !s_axil_arready && !s_axil_rvalid => !s_axil_arready
      r_stable : assert (!r_held_q || (rvalid && rresp == r_resp_q && rdata == r_data_q));
      // An answer belongs to an access, and there is one for each.
      // mutant: writable = !s_axil_awready && !s_axil_wready => writable = !s_axil_awready
      b_owed : assert (!bvalid || (aw_owed_q != '0 && w_owed_q != '0));
      // mutant: readable = !s_axil_arready && !s_axil_rvalid => readable = !s_axil_rvalid
      r_owed : assert (!rvalid || ar_owed_q != '0);
      // At most one access waits behind the one that is answered.
      // mutant: if (s_axil_awvalid) s_axil_awready <= 1'b0 => if (s_axil_awvalid && s_axil_wvalid) s_axil_awready <= 1'b0
      bounded : assert (aw_owed_q <= 2'd2 && w_owed_q <= 2'd2 && ar_owed_q <= 2'd2);
      // Answers come in time.
      // mutant: idle     = !look_q && !merge_q && !end_q => idle     = !look_q && !merge_q && !end_q && !busy_i
      b_in_time : assert (b_wait_q < 4'(BEHIND));
      // mutant: read     = end_q && !write_q => read     = end_q && !write_q && !busy_i
      r_in_time : assert (r_wait_q < 4'(BEHIND));
      // Settings change a clock after change_o, and only if the core was not busy.
      // mutant: setting_q && busy_i && !clears_q => setting_q && !clears_q && !busy_i
      draw_kept : assert (reset_q || draw == draw_q || (change_q && !busy_q));
      // mutant: draw_o  <= first => draw_o  <= '0
      draw_reset : assert (!reset_q || draw == shade_pkg::DRAW_RESET);
      // mutant: clear_o <= write && !refused => clear_o <= merge_q && !refused
      clear_told : assert (!clear || change_q);
    end
  end
endmodule
