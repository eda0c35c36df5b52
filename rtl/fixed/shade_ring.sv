// SPDX-License-Identifier: Apache-2.0
// shade_ring: q_o = d_i of DEPTH clocks ago, in a small memory: a shade_delay of a quarter of the area for many clocks.
//
// A memory of 16 words that an address runs around in. It delays by up to 16 clocks; for more, the word is as many times as
// wide, and what leaves its first part enters the second. A register stands behind the memory.
// Reset starts the address, which any start would do for but a simulator that knows unknown bits; data are not reset, and
// what is inside in a reset is lost. What is short or narrow is a shade_delay.
// BLOCK = 1: the memory may be a block RAM, for what is wide; DEPTH 3 .. 64. Its own register is slow: another stands behind it.
// Latency DEPTH clocks, one value a clock. Example: DEPTH = 9, d_i = 1, 2, 3, ... -> nine clocks later q_o = 1, 2, 3, ...
module shade_ring #(
  parameter int WIDTH = 8,
  parameter int DEPTH = 16,
  parameter int BLOCK = 0
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic [WIDTH-1:0] d_i,
  output logic [WIDTH-1:0] q_o
);
  if (WIDTH < 1 || DEPTH < 0) begin : g_check
    $error("shade_ring: WIDTH must be at least 1 and DEPTH at least 0");
  end

  if (BLOCK < 0 || BLOCK > 1 || (BLOCK == 1 && (DEPTH < 3 || DEPTH > 64))) begin : g_check_block
    $error("shade_ring: BLOCK must be 0 or 1, and DEPTH in 3 .. 64 with 1");
  end

  localparam int ADDRESS_W = BLOCK == 1 ? 6 : 4;
  localparam int WORDS = 1 << ADDRESS_W;
  if (BLOCK == 1) begin : g_block
    (* ram_style = "block" *)
    logic [WIDTH-1:0] memory[0:WORDS-1];
    logic [WIDTH-1:0] first_q;
    logic [ADDRESS_W-1:0] write_q, read_q, write;
    assign write = rst_i ? '0 : write_q + ADDRESS_W'(1);
    always_ff @(posedge clk_i) begin
      write_q         <= write;
      read_q          <= write - ADDRESS_W'(DEPTH - 2);
      memory[write_q] <= d_i;
      first_q         <= memory[read_q];
      q_o             <= first_q;
    end
  end else if (DEPTH < 8 || WIDTH * DEPTH < 48) begin : g_registers
    shade_delay #(.WIDTH(WIDTH), .DEPTH(DEPTH)) u_delay (.clk_i, .d_i, .q_o);
    logic unused_reset;
    assign unused_reset = rst_i;
  end else begin : g_memory
    localparam int PARTS = (DEPTH + WORDS - 1) / WORDS;
    localparam int CLOCKS = DEPTH / PARTS;  // of a part; the first LONGER parts take one more
    localparam int LONGER = DEPTH - PARTS * CLOCKS;
    logic [(PARTS+1)*WIDTH-1:0] data;
    logic [ADDRESS_W-1:0] write_q, read_q, older_q, write;  // read_q is CLOCKS - 1 words behind write_q, older_q CLOCKS
    assign write           = rst_i ? '0 : write_q + ADDRESS_W'(1);
    assign data[0+:WIDTH]  = d_i;
    assign q_o             = data[PARTS*WIDTH+:WIDTH];
    always_ff @(posedge clk_i) begin
      write_q <= write;
      read_q  <= write - ADDRESS_W'(CLOCKS - 1);
      older_q <= write - ADDRESS_W'(CLOCKS);
    end
    for (genvar i = 0; i < 2; i++) begin : g_kind
      localparam int FIRST = i == 0 ? 0 : LONGER;
      localparam int WORD_W = (i == 0 ? LONGER : PARTS - LONGER) * WIDTH;
      if (WORD_W > 0) begin : g_any
        logic [WORD_W-1:0] memory[0:WORDS-1];
        logic [WORD_W-1:0] last_q;
        assign data[(FIRST+1)*WIDTH+:WORD_W] = last_q;
        always_ff @(posedge clk_i) begin
          memory[write_q] <= data[FIRST*WIDTH+:WORD_W];
          last_q          <= memory[i == 0 ? older_q : read_q];
        end
      end
    end
    if (LONGER == 0) begin : g_equal
      logic unused_older;
      assign unused_older = &{1'b0, older_q};
    end
  end
endmodule
