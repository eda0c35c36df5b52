// shade_kappa: kappa = n (1 - c) of an arc of 2^k pixels, from the increment of its normals: what the planner goes by.
//
//   kappa = n |g|^2 4^k / 2       1 - c = |2^k g|^2 / 2 between unit normals
//
//   gx_i, gy_i, gz_i  S2.29       increment per pixel
//   log2_i            k           taken 2 clocks after g: shade_planner needs as long to find it
//   mantissa_i        U1.16       n = mantissa 2^exponent, mantissa in [1, 2); constant while arcs are under way
//   exponent_i        0 .. 12
//   kappa_o           U11.20      saturated
//
//   d = g 2^s           s: how many bits repeat the sign in all three components; d: the first 18 bits, the rest is cut
//   E = |d|^2           exact, 36 bits, of which the first 17 are kept
//   kappa = 2 E n 2^-r  r = 9 + 2 s - exponent - 2 k, cut; r < 0: does not fit
//
// Within 2^-12 of the exact value, relative, and 1 ulp. Four 18 x 18 multipliers.
// Latency LATENCY_KAPPA = 14 clocks, one arc a clock. Example: g = (1/128, 0, 0), k = 5, n = 32 -> 32 (1/4)^2 / 2 = 1.
// Source: P1 chooses the degree by hand, region by region; kappa alone decides the error of interpolating cos^n.
module shade_kappa (
  input  logic                                       clk_i,
  input  logic                                       rst_i,
  input  logic                                       valid_i,
  input  logic signed [       shade_pkg::STEP_W-1:0] gx_i,
  input  logic signed [       shade_pkg::STEP_W-1:0] gy_i,
  input  logic signed [       shade_pkg::STEP_W-1:0] gz_i,
  input  logic        [       shade_pkg::LOG2_W-1:0] log2_i,
  input  logic        [    shade_pkg::SHARPNESS_F:0] mantissa_i,
  input  logic        [shade_pkg::SHARPNESS_EXP_W-1:0] exponent_i,
  output logic                                       valid_o,
  output logic        [      shade_pkg::KAPPA_W-1:0] kappa_o
);
  localparam int W = shade_pkg::STEP_W;
  localparam int D_W = 18;
  localparam int MUL = shade_pkg::LATENCY_MUL;

  // ---- s, in steps of 8, 2 and 1: the first bit that differs from its component's sign goes to the front -----------
  localparam int W2 = D_W + 7;  // of g: what the next steps can still bring to the front
  localparam int W3 = D_W + 1;
  logic [W-1:0] differs_q1;
  logic [7:0] differs_q2;
  logic [1:0] eights, eights_q2, eights_q3, twos, twos_q3;
  logic front_q3;
  logic [4:0] s_q4;
  always_comb begin
    if (|differs_q1[W-1-:8]) eights = 2'd0;
    else if (|differs_q1[W-9-:8]) eights = 2'd1;
    else if (|differs_q1[W-17-:8]) eights = 2'd2;
    else eights = 2'd3;

    if (|differs_q2[7-:2]) twos = 2'd0;
    else if (|differs_q2[5-:2]) twos = 2'd1;
    else if (|differs_q2[3-:2]) twos = 2'd2;
    else twos = 2'd3;
  end
  always_ff @(posedge clk_i) begin
    differs_q1 <= {gx_i[W-1:1] ^ gx_i[W-2:0] | gy_i[W-1:1] ^ gy_i[W-2:0] | gz_i[W-1:1] ^ gz_i[W-2:0], 1'b0};
    differs_q2 <= 8'((differs_q1 << {eights, 3'b000}) >> (W - 8));
    front_q3   <= differs_q2[{~twos, 1'b1}];
    eights_q2  <= eights;
    eights_q3  <= eights_q2;
    twos_q3    <= twos;
    s_q4       <= {eights_q3, twos_q3, !front_q3};
  end

  localparam int E_W = 2 * D_W;  // at most 3 * 2^34
  logic [3*W-1:0] g_q1;
  logic [3*E_W-1:0] squares_q6;
  always_ff @(posedge clk_i) g_q1 <= {gz_i, gy_i, gx_i};
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic [W-1:0] eighth;
    logic [W2-1:0] g_q2, half;
    logic [W3-1:0] g_q3;
    logic signed [D_W-1:0] d_q4;
    logic signed [E_W-1:0] square_q6;
    assign eighth = g_q1[c*W+:W] << {eights, 3'b000};
    assign half   = g_q2 << {twos, 1'b0};
    always_ff @(posedge clk_i) begin
      g_q2 <= eighth[W-1-:W2];
      g_q3 <= half[W2-1-:W3];
      d_q4 <= front_q3 ? g_q3[W3-1-:D_W] : g_q3[D_W-1:0];
    end
    shade_mul #(.A_W(D_W), .B_W(D_W)) u_square (.clk_i, .a_i(d_q4), .b_i(d_q4), .p_o(square_q6));
    assign squares_q6[c*E_W+:E_W] = square_q6;
    logic unused_bits;
    assign unused_bits = &{1'b0, eighth, half};
  end

  // ---- E, and its product with the mantissa ----------------------------------------------------------------------
  localparam int KEPT_W = 17;
  localparam int P_W = KEPT_W + shade_pkg::SHARPNESS_F + 2;  // of twice the product
  logic [E_W-1:0] two_q7, third_q7, e_q8, product_q10;
  always_ff @(posedge clk_i) begin
    two_q7   <= squares_q6[0+:E_W] + squares_q6[E_W+:E_W];
    third_q7 <= squares_q6[2*E_W+:E_W];
    e_q8     <= two_q7 + third_q7;
  end
  shade_mul #(.A_W(KEPT_W + 1), .B_W(shade_pkg::SHARPNESS_F + 2)) u_product (
    .clk_i, .a_i({1'b0, e_q8[E_W-1-:KEPT_W]}), .b_i({1'b0, mantissa_i}), .p_o(product_q10)
  );

  // ---- shifted by r, in steps of 16, 4 and 1 -----------------------------------------------------------------------
  localparam int R_W = 8;  // -32 .. 71
  logic signed [R_W-1:0] rest_q3, rest_q4, r_q5, r_q10;
  logic [3:0] r_q11;
  logic [1:0] r_q12;
  logic [P_W-1:0] p_q11, p_q12, p_q13;
  logic over_q11, over_q13;
  always_ff @(posedge clk_i) begin
    rest_q3 <= R_W'(9) - $signed(R_W'(exponent_i)) - $signed(R_W'({log2_i, 1'b0}));
    rest_q4 <= rest_q3;
    r_q5    <= rest_q4 + $signed(R_W'({s_q4, 1'b0}));

    over_q11 <= r_q10[R_W-1];
    r_q11    <= r_q10[3:0];
    p_q11    <= r_q10[R_W-2] ? '0 : {product_q10[P_W-2:0], 1'b0} >> {r_q10[5:4], 4'b0000};
    r_q12    <= r_q11[1:0];
    p_q12    <= p_q11 >> {r_q11[3:2], 2'b00};
    p_q13    <= p_q12 >> r_q12;
    kappa_o  <= p_q13[shade_pkg::KAPPA_W-1:0] | {shade_pkg::KAPPA_W{over_q13 || |p_q13[P_W-1:shade_pkg::KAPPA_W]}};
  end
  shade_delay #(.WIDTH(R_W), .DEPTH(2 * MUL + 1)) u_r (.clk_i, .d_i(r_q5), .q_o(r_q10));
  shade_delay #(.WIDTH(1), .DEPTH(2)) u_over (.clk_i, .d_i(over_q11), .q_o(over_q13));

  shade_valid #(.DEPTH(shade_pkg::LATENCY_KAPPA)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
  logic unused_product;
  assign unused_product = &{1'b0, product_q10, e_q8};
endmodule
