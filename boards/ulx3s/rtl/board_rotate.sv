// SPDX-License-Identifier: Apache-2.0
// board_rotate: the vertices of the head turned about the vertical axis, projected, into a memory of their own.
//
//   x' = x cos + z sin      z' = z cos - x sin      of places, 1/256 pixel, and of normals, S0.15: rounded to nearest
//   column 160 256 + x', line 120 256 - y, depth 2^15 - z'
//
// One multiplier, 12 clocks a vertex. start_i begins with vertex 0; busy_o until the last one is written. read_i -> corner_o
// 2 clocks later: {nz, ny, nx, depth, line, column}. Example: angle_i = 64, a quarter turn: what was right is behind.
module board_rotate #(
  parameter int COUNT = 512
) (
  input  logic        clk_i,
  input  logic        rst_i,
  input  logic        start_i,
  input  logic [ 7:0] angle_i,
  output logic        busy_o,
  input  logic [ 9:0] read_i,
  output logic [96:0] corner_o
);
  logic [95:0] vertices[0:511];  // {nz, ny, nx, z, y, x}
  logic [35:0] angles[0:255];  // {sin, cos}, S1.16
  logic [96:0] corners[0:511];
  initial $readmemh("vertices.hex", vertices);
  initial $readmemh("angles.hex", angles);

  logic [9:0] at_q;
  logic [3:0] step_q;
  logic [95:0] vertex;
  logic [35:0] angle;
  logic signed [15:0] x, y, z, nx, ny, nz;
  assign {nz, ny, nx, z, y, x} = vertex;
  always_ff @(posedge clk_i) begin
    vertex <= vertices[at_q[8:0]];
    angle  <= angles[angle_i];
    step_q <= step_q == 4'd11 ? 4'd0 : step_q + 4'd1;
    if (busy_o && step_q == 4'd11) begin
      at_q   <= at_q + 10'd1;
      busy_o <= at_q != 10'(COUNT - 1);
    end
    if (start_i) begin
      step_q <= 4'd0;
      at_q   <= 10'd0;
      busy_o <= 1'b1;
    end
    if (rst_i) busy_o <= 1'b0;
  end

  // step 1 .. 8: a product each, out two clocks later
  logic signed [17:0] a, b, sine, cosine;
  logic signed [35:0] product, first_q;
  assign {sine, cosine} = angle;
  always_comb begin
    case (step_q)
      4'd1: a = 18'(x);
      4'd2: a = 18'(z);
      4'd3: a = 18'(z);
      4'd4: a = 18'(x);
      4'd5: a = 18'(nx);
      4'd6: a = 18'(nz);
      4'd7: a = 18'(nz);
      default: a = 18'(nx);
    endcase
    b = step_q[0] ? cosine : sine;
  end
  shade_mul #(.A_W(18), .B_W(18)) u_product (.clk_i, .a_i(a), .b_i(b), .p_o(product));

  // pairs of products: the first one waits
  function automatic logic signed [15:0] rounded(input logic signed [35:0] sum);
    rounded = 16'((sum + 36'sd32768) >>> 16);
  endfunction
  logic signed [15:0] x_q, z_q, nx_q;
  always_ff @(posedge clk_i) begin
    first_q <= product;
    if (step_q == 4'd4) x_q <= rounded(first_q + product);
    if (step_q == 4'd6) z_q <= rounded(first_q - product);
    if (step_q == 4'd8) nx_q <= rounded(first_q + product);
    if (busy_o && step_q == 4'd10) begin
      corners[at_q[8:0]] <= {
        rounded(first_q - product), ny, nx_q, 16'(17'sd32768 - 17'(z_q)), 16'(17'sd30720 - 17'(y)), 17'(18'sd40960 + 18'(x_q))
      };
    end
  end
  logic [96:0] corner_q;
  always_ff @(posedge clk_i) begin
    corner_q <= corners[read_i[8:0]];
    corner_o <= corner_q;
  end
  logic unused_bits;
  assign unused_bits = &{1'b0, read_i[9]};
endmodule
