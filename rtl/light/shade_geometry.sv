// SPDX-License-Identifier: Apache-2.0
// shade_geometry: g = num (1 + w) 2^e, by which a light model multiplies its lobe: masking and the quotients.
//
//   Phong, Blinn    1, with .cosine N.L
//   Schlick         r / (x 2^inv_n_exp + r), r = N.H inv_n     c / (n - n c + c), the rational lobe itself (1/n = inv_n 2^-..)
//   Cook-Torrance   min(1, 2 N.H N.L / V.H, 2 N.H N.V / V.H) / ((N.L) (N.V)) = num / den, with large = max(N.L, N.V) and
//                   small = min(..): 2 N.H / (large V.H) where 2 N.H small < V.H (masked), else 1 / (large small)
//   Ward            1 / sqrt(large small)
//   others, den = 0 (factor_o.zero)   0
//
//   angles_i.x       d.ffff ff         U2.26, the versine of N and H: N.H = 1 - x, x cut to U2.20, rounded to U1.16, not
//                                      below 0; x 2^inv_n_exp is cut to 20 fraction bits
//   den                                exact (x = 2 counts as 2 - 2^-26): U2.32, of Schlick U16.20; 36 bits
//   1/sqrt(den)                        (1 + d) 2^-.. by shade_rsqrt, d S0.18; its square is 1/den, doubled if below 1/2
//   factor_o.num     d.ffff            U1.16: 1, N.L, r or N.H; r rounded to nearest
//   factor_o.w, .e  s0.ffff ff         S0.18 in [-1/2, 0], -15 .. 33; 1 + w within 2^-16 (relative)
//
// num (1 + w) within 1.8 ulp of num (2^-16) of g 2^-e from the inputs as they are.
//
// Five 18 x 18 multipliers, two of them in shade_rsqrt. material_i must not change while values are inside.
// Latency LATENCY_GEOMETRY = 22 clocks, one value a clock. Source: P1, Cook-Torrance and Ward; Schlick's lobe.
// Example: Ward, N.L = 1/4, N.V = 1 -> den = 1/4, num = 1, w = 0, e = 1.
module shade_geometry (
  input  logic                            clk_i,
  input  logic                            rst_i,
  input  shade_pkg::material_t            material_i,
  input  shade_pkg::angles_t              angles_i,
  input  logic [shade_pkg::INTENSITY_F:0] vh_i,       // U1.16
  output shade_pkg::factor_t              factor_o
);
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int C_W = F + 1;
  localparam int X_F = shade_pkg::VERSINE_F - shade_pkg::VERSINE_CUT;
  localparam int X_W = X_F + 2;
  localparam int W_F = shade_pkg::FACTOR_F;
  localparam int E_W = shade_pkg::FACTOR_EXP_W;
  localparam int Z_W = shade_pkg::RSQRT_W;
  localparam int Y_W = shade_pkg::RSQRT_F + 1;
  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int ROOT = shade_pkg::LATENCY_RSQRT;
  localparam logic [C_W-1:0] ONE = C_W'(1) << F;

  logic [X_W-1:0] x;
  assign x = X_W'(angles_i.x >> shade_pkg::VERSINE_CUT);
  logic schlick, cook, ward, plain, divides;
  assign schlick = material_i.model == shade_pkg::MODEL_W'(shade_pkg::MODEL_SCHLICK);
  assign cook    = material_i.model == shade_pkg::MODEL_W'(shade_pkg::MODEL_COOK_TORRANCE);
  assign ward    = material_i.model == shade_pkg::MODEL_W'(shade_pkg::MODEL_WARD);
  assign plain   = material_i.model == shade_pkg::MODEL_W'(shade_pkg::MODEL_PHONG)
                || material_i.model == shade_pkg::MODEL_W'(shade_pkg::MODEL_BLINN);
  assign divides = schlick || cook || ward;

  // ---- N.H; the product that decides on masking, or r ------------------------------------------------------------
  // lead: N.H, of Phong and Blinn N.L. other: the smaller cosine, of Schlick 1/n.
  localparam logic signed [X_W:0] ONE_AND_HALF_ULP = ((X_W + 1)'(1) <<< X_F) + ((X_W + 1)'(1) <<< (X_F - F - 1));
  logic signed [X_W:0] complement;
  logic descending;
  logic [C_W-1:0] lead_q1, lead_q3, other_q1, other_q3, large_q1, large_q4, vh_q3, r_q4, r_q6, num_q4, num_q21, right_q4;
  logic [2*C_W+1:0] product_q3, den_q6;
  logic masked, masked_q4, masked_q17;
  assign complement = ONE_AND_HALF_ULP - (X_W + 1)'({1'b0, x});
  assign descending = angles_i.nl > angles_i.nv;
  always_ff @(posedge clk_i) begin
    lead_q1  <= plain ? angles_i.nl : complement[X_W] ? '0 : C_W'(complement >>> (X_F - F));
    large_q1 <= descending ? angles_i.nl : angles_i.nv;
    other_q1 <= schlick ? material_i.inv_n : descending ? angles_i.nv : angles_i.nl;
  end
  shade_mul #(.A_W(C_W + 1), .B_W(C_W + 1)) u_product (
    .clk_i, .a_i({1'b0, lead_q1}), .b_i({1'b0, other_q1}), .p_o(product_q3)
  );
  shade_delay #(.WIDTH(2 * C_W), .DEPTH(MUL)) u_cosines (
    .clk_i, .d_i({lead_q1, other_q1}), .q_o({lead_q3, other_q3})
  );
  shade_delay #(.WIDTH(C_W), .DEPTH(1 + MUL)) u_vh (.clk_i, .d_i(vh_i), .q_o(vh_q3));
  shade_delay #(.WIDTH(C_W), .DEPTH(MUL + 1)) u_large (.clk_i, .d_i(large_q1), .q_o(large_q4));
  assign masked = cook && other_q3 != '0 && (C_W + 1)'(product_q3 >> (F - 1)) < {1'b0, vh_q3};  // 0 < small, 2 N.H small < V.H
  always_ff @(posedge clk_i) begin
    masked_q4 <= masked;
    right_q4  <= masked ? vh_q3 : other_q3;
    r_q4      <= C_W'(product_q3 >> F) + C_W'(product_q3[F-1]);
    num_q4    <= masked || (plain && material_i.cosine) ? lead_q3 : plain || divides ? ONE : '0;
  end

  // ---- the denominator and its root ------------------------------------------------------------------------------
  localparam int CUT = shade_pkg::VERSINE_CUT;
  localparam int FINE_W = shade_pkg::VERSINE_W - 1;  // x below 2
  logic [FINE_W-1:0] below_two, x_q4;
  assign below_two = FINE_W'(angles_i.x) | {FINE_W{x[X_W-1]}};
  logic [Z_W+CUT-1:0] x_q5;
  logic [Z_W-1:0] x_q6, z_q7;
  logic [Y_W-1:0] y_q17;
  logic [4:0] e_q17;
  logic zero_q17;
  logic [1:0] fours, ones;
  assign {fours, ones} = material_i.inv_n_exp;
  shade_mul #(.A_W(C_W + 1), .B_W(C_W + 1)) u_den (
    .clk_i, .a_i({1'b0, large_q4}), .b_i({1'b0, right_q4}), .p_o(den_q6)
  );
  shade_delay #(.WIDTH(FINE_W), .DEPTH(1 + MUL + 1)) u_x (
    .clk_i, .d_i(below_two), .q_o(x_q4)
  );
  shade_delay #(.WIDTH(C_W), .DEPTH(MUL)) u_r (.clk_i, .d_i(r_q4), .q_o(r_q6));
  always_ff @(posedge clk_i) begin
    x_q5 <= (Z_W + CUT)'(x_q4) << {fours, 2'b00};
    x_q6 <= Z_W'((x_q5 << ones) >> CUT);
    z_q7 <= schlick ? x_q6 + (Z_W'(r_q6) << (X_F - F)) : Z_W'(den_q6);
  end
  shade_rsqrt u_rsqrt (.clk_i, .z_i(z_q7), .y_o(y_q17), .e_o(e_q17), .zero_o(zero_q17));

  // ---- 1 + w: the root, or its square, doubled where it is below 1/2 ---------------------------------------------
  localparam int S_W = 2 * W_F + 1;
  logic signed [W_F-1:0] d, d_q18, d_q20;
  logic [2*W_F-2:0] dd_q20;
  logic signed [S_W-1:0] square_q21, doubled;  // (1 + d)^2 - 1 in [-3/4, 0], of Ward d
  logic signed [W_F-1:0] w;
  logic twice, zero_q21;
  logic signed [E_W-1:0] base, e_q18, e_q21;
  shade_round #(.WIDTH(Y_W), .DROP(Y_W - 1 - W_F), .OUT_W(W_F)) u_d (
    .x_i({!y_q17[Y_W-1], y_q17[Y_W-2:0]}), .y_o(d)  // y - 1
  );
  shade_square #(.WIDTH(W_F)) u_square (.clk_i, .x_i(d_q18), .y_o(dd_q20));
  shade_delay #(.WIDTH(W_F), .DEPTH(MUL)) u_wait_d (.clk_i, .d_i(d_q18), .q_o(d_q20));
  shade_delay #(.WIDTH(1), .DEPTH(MUL + 1 + ROOT)) u_masked (.clk_i, .d_i(masked_q4), .q_o(masked_q17));
  shade_delay #(.WIDTH(E_W), .DEPTH(MUL + 1)) u_e (.clk_i, .d_i(e_q18), .q_o(e_q21));
  shade_delay #(.WIDTH(1), .DEPTH(1 + MUL + 1)) u_zero (.clk_i, .d_i(divides && zero_q17), .q_o(zero_q21));
  shade_ring #(.WIDTH(C_W), .DEPTH(MUL + 1 + ROOT + 1 + MUL + 1)) u_num (
    .clk_i, .rst_i, .d_i(schlick ? r_q4 : num_q4), .q_o(num_q21)
  );
  assign base    = ward ? E_W'(F) : schlick ? E_W'(X_F) : E_W'(2 * F) + E_W'({1'b0, masked_q17});
  assign twice   = square_q21[S_W-1] && !square_q21[S_W-2];
  assign doubled = twice ? {1'b1, square_q21[S_W-3:0], 1'b0} : square_q21;  // 2 (1 + d)^2 - 1
  shade_round #(.WIDTH(S_W), .DROP(W_F), .OUT_W(W_F)) u_w (.x_i(doubled), .y_o(w));
  always_ff @(posedge clk_i) begin
    d_q18         <= divides ? d : '0;
    e_q18         <= divides ? base - (ward ? E_W'({1'b0, e_q17}) : E_W'({e_q17, 1'b0})) : '0;
    square_q21    <= ward ? S_W'(d_q20) <<< W_F : (S_W'(d_q20) <<< (W_F + 1)) + S_W'({2'b00, dd_q20});
    factor_o.w    <= w;
    factor_o.e    <= e_q21 - E_W'({1'b0, twice});
    factor_o.num  <= zero_q21 ? '0 : num_q21;
    factor_o.zero <= zero_q21;
  end
  logic unused;
  assign unused = &{1'b0, material_i, angles_i};
endmodule
