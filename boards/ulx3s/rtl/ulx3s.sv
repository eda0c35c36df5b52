// SPDX-License-Identifier: Apache-2.0
// ulx3s: the top of the board: a PLL, reset, buttons, and the pins of the video connector.
//
// 25 MHz in; 25 MHz for everything, 125 MHz for the pins, which give two bits a clock. btn[1], FIRE1: the next model;
// btn[2], FIRE2: the next shininess; led: model, level, pictures. Example: gpdi_dp[3] is the pixel clock, 1111100000.
module ulx3s #(
  parameter int VERTEX_COUNT   = 512,
  parameter int TRIANGLE_COUNT = 1000
) (
  input  logic       clk_25mhz,
  input  logic [6:0] btn,
  output logic [7:0] led,
  output logic [3:0] gpdi_dp,
  output logic       wifi_gpio0
);
  logic clk, fast, locked;
  assign wifi_gpio0 = 1'b1;  // at 0 the WiFi module takes the board over
  (* FREQUENCY_PIN_CLKI = "25", FREQUENCY_PIN_CLKOP = "125", FREQUENCY_PIN_CLKOS = "25" *)
  EHXPLLL #(
    .CLKI_DIV(1), .CLKFB_DIV(5), .CLKOP_DIV(5), .CLKOS_DIV(25), .CLKOP_ENABLE("ENABLED"), .CLKOS_ENABLE("ENABLED"),
    .CLKOP_CPHASE(4), .CLKOS_CPHASE(24), .FEEDBK_PATH("CLKOP")
  ) u_pll (
    .CLKI(clk_25mhz), .CLKFB(fast), .CLKOP(fast), .CLKOS(clk), .LOCK(locked), .RST(1'b0), .STDBY(1'b0), .PHASESEL0(1'b0),
    .PHASESEL1(1'b0), .PHASEDIR(1'b0), .PHASESTEP(1'b0), .PHASELOADREG(1'b0), .PLLWAKESYNC(1'b0), .ENCLKOP(1'b0),
    .ENCLKOS(1'b0), .ENCLKOS2(1'b0), .ENCLKOS3(1'b0)
  );

  // reset for a while behind the lock; buttons through two registers
  logic [7:0] wait_q;
  logic [1:0] press_q1, press_q2;
  logic rst_q;
  always_ff @(posedge clk) begin
    if (!locked) wait_q <= '0;
    else if (!wait_q[7]) wait_q <= wait_q + 8'd1;
    rst_q    <= !wait_q[7];
    press_q1 <= btn[2:1];
    press_q2 <= press_q1;
  end

  logic [3:0][9:0] symbol;
  board_machine #(.VERTEX_COUNT(VERTEX_COUNT), .TRIANGLE_COUNT(TRIANGLE_COUNT)) u_machine (
    .clk_i(clk), .rst_i(rst_q), .model_i(press_q2[0]), .level_i(press_q2[1]), .red_o(symbol[2]), .green_o(symbol[1]),
    .blue_o(symbol[0]), .told_o(led)
  );
  assign symbol[3] = 10'b0000011111;
  for (genvar i = 0; i < 4; i++) begin : g_pin
    logic [1:0] bits;
    board_serial u_serial (.clk_i(clk), .fast_i(fast), .symbol_i(symbol[i]), .pair_o(bits));
    ODDRX1F u_pin (.SCLK(fast), .RST(1'b0), .D0(bits[0]), .D1(bits[1]), .Q(gpdi_dp[i]));
  end
  logic unused_buttons;
  assign unused_buttons = &{1'b0, btn[6:3], btn[0]};
endmodule
