// SPDX-License-Identifier: Apache-2.0
// Models of the two blocks of the ECP5 that the top names, as far as it uses them: five fast clocks for each of 40 ns that come
// in, and two bits a clock at a pin.
`timescale 1ns / 1ps
module EHXPLLL #(
  parameter CLKI_DIV = 1, CLKFB_DIV = 1, CLKOP_DIV = 1, CLKOS_DIV = 1, CLKOP_ENABLE = "", CLKOS_ENABLE = "",
  parameter CLKOP_CPHASE = 0, CLKOS_CPHASE = 0, FEEDBK_PATH = ""
) (
  input CLKI, CLKFB, RST, STDBY, PHASESEL0, PHASESEL1, PHASEDIR, PHASESTEP, PHASELOADREG, PLLWAKESYNC, ENCLKOP, ENCLKOS,
  input ENCLKOS2, ENCLKOS3,
  output reg CLKOP, CLKOS, LOCK
);
  initial {CLKOP, CLKOS, LOCK} = 3'b000;
  always @(posedge CLKI) begin
    LOCK <= 1'b1;
    CLKOS = 1'b1;
    CLKOP = 1'b1;
    #4 CLKOP = 1'b0;
    #4 CLKOP = 1'b1;
    #4 CLKOP = 1'b0;
    #4 CLKOP = 1'b1;
    #4 CLKOP = 1'b0;
    CLKOS = 1'b0;
    #4 CLKOP = 1'b1;
    #4 CLKOP = 1'b0;
    #4 CLKOP = 1'b1;
    #4 CLKOP = 1'b0;
  end
  // the fifth period ends with the next edge that comes in
endmodule

module ODDRX1F (
  input SCLK, RST, D0, D1,
  output Q
);
  reg first, second;
  always @(posedge SCLK) begin
    first  <= D0;
    second <= D1;
  end
  assign Q = SCLK ? first : second;
endmodule
