// SPDX-License-Identifier: Apache-2.0
// shade_patch_dots: the dot products that the light of a box's pixels is made of, one a clock: for a triangle's first box
//
//   L.dx, L.dy, H.dx, H.dy, dx.dx, dx.dy, dy.dy, and for every box  N.L, N.H, N.N, N.dx, N.dy        S4.22, in this order
//
//   n_i, dx_i, dy_i, first_i   of shade_patch_walk, taken with ready_o; x at bit 0
//   l_i, h_i                   settings, L and H
//   room_i                     0: no more than a dozen products may follow
//
// Three multipliers. Latency 1 + LATENCY_DOT3 clocks; a box takes 5 clocks, a triangle's first one 12.
// Example: N = H = (0, 0, 1), dx = dy = 0 -> 0 x 7, N.L, 1, 1, 0, 0.
module shade_patch_dots (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  logic [3*shade_pkg::INTENSITY_W-1:0] l_i,
  input  logic [3*shade_pkg::INTENSITY_W-1:0] h_i,
  input  logic                                valid_i,
  output logic                                ready_o,
  input  logic [3*shade_pkg::INTENSITY_W-1:0] n_i,
  input  logic [3*shade_pkg::INTENSITY_W-1:0] dx_i,
  input  logic [3*shade_pkg::INTENSITY_W-1:0] dy_i,
  input  logic                                first_i,
  input  logic                                room_i,
  output logic                                valid_o,
  output logic [                         3:0] which_o,  // 0 .. 11, in the order above
  output logic [  shade_pkg::PATCH_DOT_W-1:0] dot_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam logic [3:0] LAST = 4'd11;
  logic busy_q, valid_q;
  logic [3:0] op_q, op, which_q;
  logic [3*W-1:0] a, b, a_q, b_q;
  assign op      = busy_q ? op_q : first_i ? 4'd0 : 4'd7;
  assign ready_o = busy_q && op_q == LAST;
  always_comb begin
    case (op)
      4'd0, 4'd2, 4'd4, 4'd5: a = dx_i;
      4'd1, 4'd3, 4'd6:       a = dy_i;
      default:                a = n_i;
    endcase
    case (op)
      4'd0, 4'd1, 4'd7: b = l_i;
      4'd2, 4'd3, 4'd8: b = h_i;
      4'd9:             b = n_i;
      4'd4, 4'd10:      b = dx_i;
      default:          b = dy_i;
    endcase
  end
  always_ff @(posedge clk_i) begin
    a_q     <= a;
    b_q     <= b;
    valid_q <= busy_q || (valid_i && room_i);
    op_q    <= op + 4'd1;
    which_q <= op;
    if (busy_q) busy_q <= op_q != LAST;
    else busy_q <= valid_i && room_i;
    if (rst_i) {busy_q, valid_q} <= 2'b00;
  end
  shade_dot3 #(.OUT_F(shade_pkg::PATCH_DOT_F)) u_dot (
    .clk_i, .a_i(a_q), .b_i(b_q), .d_o(dot_o)
  );
  shade_valid #(.DEPTH(shade_pkg::LATENCY_DOT3)) u_valid (.clk_i, .rst_i, .valid_i(valid_q), .valid_o);
  shade_delay #(.WIDTH(4), .DEPTH(shade_pkg::LATENCY_DOT3)) u_which (.clk_i, .d_i(which_q), .q_o(which_o));
endmodule
