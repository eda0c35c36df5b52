// SPDX-License-Identifier: Apache-2.0
// The board and a screen: what comes out of the video pins is taken apart into symbols and written to a file, one
// pixel clock a line: blue, green, red, hexadecimal; "frame N M L" in front of those of a picture: pictures drawn so far, model and level of the one that is drawn.
// +frames=N: so many pictures; +model=N, +level=N: the buttons are pressed in picture N.
`timescale 1ns / 1ps
module bench #(
  parameter int VERTEX_COUNT   = 512,
  parameter int TRIANGLE_COUNT = 1000
);
  logic clk, model, level;
  logic [7:0] led;
  logic [3:0] pins;
  logic unused_wifi;
  initial clk = 1'b0;
  always #20 clk = !clk;
  ulx3s #(.VERTEX_COUNT(VERTEX_COUNT), .TRIANGLE_COUNT(TRIANGLE_COUNT)) u_board (
    .clk_25mhz(clk), .btn({4'b0000, level, model, 1'b1}), .led, .gpdi_dp(pins), .wifi_gpio0(unused_wifi)
  );

  // a bit every 4 ns, taken in its middle; the clock's channel tells where a symbol begins
  logic sample;
  initial begin
    sample = 1'b0;
    #2;
    forever begin
      sample = 1'b1;
      #2 sample = 1'b0;
      #2;
    end
  end
  logic [3:0] last;
  logic [29:0] bits;
  logic [3:0] count;
  int file, frames, wanted, press_model, press_level;
  initial begin
    file = $fopen("symbols.txt", "w");
    if ($value$plusargs("frames=%d", wanted) == 0) wanted = 2;
    if ($value$plusargs("model=%d", press_model) == 0) press_model = -1;
    if ($value$plusargs("level=%d", press_level) == 0) press_level = -1;
    {model, level, frames} = '0;
    {last, bits, count} = '0;
  end
  localparam logic [9:0] BOTH = 10'b1101010100;  // control 0: both syncs are low active, this is a line of vertical sync
  logic vsync;
  always @(posedge sample) begin
    bits <= {pins[2], bits[29:21], pins[1], bits[19:11], pins[0], bits[9:1]};
    last <= pins;
    count <= count == 4'd9 || (pins[3] && !last[3]) ? 4'd0 : count + 4'd1;
    if (pins[3] && !last[3]) begin  // the ten bits before are a symbol of each channel
      vsync <= bits[9:0] == BOTH || bits[9:0] == 10'b0010101011;
      if (!vsync && (bits[9:0] == BOTH || bits[9:0] == 10'b0010101011)) begin
        frames <= frames + 1;
        model  <= frames == press_model;
        level  <= frames == press_level;
        $fdisplay(file, "frame %0d %0d %0d", u_board.u_machine.drawn_q, u_board.u_machine.models_q, u_board.u_machine.levels_q);
        if (frames == wanted) begin
          $fclose(file);
          $finish;
        end
      end
      $fdisplay(file, "%h", bits);
    end
  end
endmodule
