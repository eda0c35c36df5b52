// shade_delay: q_o = d_i of DEPTH clocks ago.
//
// Aligns data that need no arithmetic with the results of a pipeline beside them. Not reset. DEPTH = 0 is a wire.
// What is short or narrow is a shift register. Eight bits and eight clocks or more go round in small memories of 16
// words, one behind the other, each with a register behind it: a quarter of the area. The words written meanwhile need
// no reset either: the addresses' distance counts, not where they begin.
// Latency DEPTH clocks, one value a clock. Example: DEPTH = 2, d_i = 5, 6, 7, 8 -> q_o = x, x, 5, 6.
module shade_delay #(
  parameter int WIDTH = 8,
  parameter int DEPTH = 2
) (
  input  logic             clk_i,
  input  logic [WIDTH-1:0] d_i,
  output logic [WIDTH-1:0] q_o
);
  if (WIDTH < 1 || DEPTH < 0) begin : g_check
    $error("shade_delay: WIDTH must be at least 1 and DEPTH at least 0");
  end

  localparam int ADDRESS_W = 4;
  localparam int WORDS = 1 << ADDRESS_W;
  if (DEPTH == 0) begin : g_wire
    assign q_o = d_i;
    logic unused_clk;
    assign unused_clk = clk_i;
  end else if (WIDTH < 8 || DEPTH < 8) begin : g_shift
    localparam int BITS = WIDTH * DEPTH;
    logic [BITS-1:0] line_q;
    always_ff @(posedge clk_i) line_q <= BITS'({line_q, d_i});
    assign q_o = line_q[BITS-1-:WIDTH];
  end else begin : g_ring
    localparam int RINGS = (DEPTH + WORDS - 1) / WORDS;
    logic [ADDRESS_W-1:0] write_q, write;
    initial write_q = '0;
    assign write = write_q + ADDRESS_W'(1);
    always_ff @(posedge clk_i) write_q <= write;
    logic [(RINGS+1)*WIDTH-1:0] data;
    assign data[WIDTH-1:0] = d_i;
    assign q_o             = data[RINGS*WIDTH+:WIDTH];
    for (genvar i = 0; i < RINGS; i++) begin : g_one
      localparam int CLOCKS = i < RINGS - 1 ? WORDS : DEPTH - i * WORDS;
      logic [WIDTH-1:0] last_q;
      assign data[(i+1)*WIDTH+:WIDTH] = last_q;
      if (CLOCKS == 1) begin : g_register
        always_ff @(posedge clk_i) last_q <= data[i*WIDTH+:WIDTH];
      end else begin : g_memory
        logic [WIDTH-1:0] memory[0:WORDS-1];
        logic [ADDRESS_W-1:0] read_q;  // CLOCKS - 1 words behind write_q
        initial read_q = '0;
        always_ff @(posedge clk_i) begin
          read_q          <= write - ADDRESS_W'(CLOCKS - 1);
          memory[write_q] <= data[i*WIDTH+:WIDTH];
          last_q          <= memory[read_q];
        end
      end
    end
  end
endmodule
