// SPDX-License-Identifier: Apache-2.0
// shade_square_fabric: y = x^2, exact, without a DSP block.
//
//   x_i     dddd dddd             WIDTH bits, unsigned
//   y_o     dddd dddd dddd dddd   2 WIDTH bits, overflow is impossible
//
// Every product of two different bits stands once, doubled: with u the bits above bit i,
//
//   x^2 = sum over i of 4^i x_i (4 u + 1)
//
// one row a bit; the two upper bits share one, which needs no adder. A tree adds the rows, a register behind every level.
// Latency LATENCY_SQUARE_FABRIC = 4 clocks for WIDTH 10 .. 17, else ceil(log2(WIDTH - 1)); one value a clock.
// Example: x = 3 -> y = 9.
module shade_square_fabric #(
  parameter int WIDTH = 17
) (
  input  logic               clk_i,
  input  logic [  WIDTH-1:0] x_i,
  output logic [2*WIDTH-1:0] y_o
);
  if (WIDTH < 3 || WIDTH > 18) begin : g_check
    $error("shade_square_fabric: WIDTH must be in 3 .. 18");
  end

  localparam int ROWS = WIDTH - 1;
  localparam int LEVELS = $clog2(ROWS);

  for (genvar level = 0; level <= LEVELS; level++) begin : g_level
    localparam int SPAN = 1 << level;  // rows in a sum, which is in units of 4^first
    for (genvar first = 0; first < ROWS; first += SPAN) begin : g_sum
      localparam int ALL_W = 2 * (WIDTH - first);
      localparam int SUM_W = WIDTH - first + 1 + SPAN;
      localparam int W = SUM_W < ALL_W ? SUM_W : ALL_W;
      logic [W-1:0] total;
      if (level == 0) begin : g_row
        if (first < ROWS - 1) begin : g_bit
          assign total = W'({x_i >> (first + 1), 2'b01}) & {W{x_i[first]}};
        end else begin : g_two
          assign total = {x_i[WIDTH-1] && x_i[WIDTH-2], x_i[WIDTH-1] && !x_i[WIDTH-2], 1'b0, x_i[WIDTH-2]};
        end
      end else begin : g_add
        localparam int LATER = first + SPAN / 2;
        if (LATER < ROWS) begin : g_pair
          // the lower bits of the first are those of the sum: the adder is that much shorter
          always_ff @(posedge clk_i) begin
            total <= {(W - SPAN)'(g_level[level-1].g_sum[first].total >> SPAN)
                      + (W - SPAN)'(g_level[level-1].g_sum[LATER].total),
                      SPAN'(g_level[level-1].g_sum[first].total)};
          end
        end else begin : g_single
          always_ff @(posedge clk_i) total <= W'(g_level[level-1].g_sum[first].total);
        end
      end
    end
  end
  assign y_o = g_level[LEVELS].g_sum[0].total;
endmodule
