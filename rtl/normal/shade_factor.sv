// SPDX-License-Identifier: Apache-2.0
// shade_factor: what the sum of two unit normals is multiplied by to get the normal in their middle, by P4's variants.
//
//   variant_i          s
//   VARIANT_REFINED    InvC, anchored            VARIANT_V1, _V2   InvC1, InvC2 where needs_d1_i, else 1/2
//   VARIANT_V3, _V6    1/2, the mean             VARIANT_V4, _V5   InvC1, InvC2 where d2 < threshold, else 1/2
//
//   a_i, b_i       S1.16, the two neighbours; c of d2 and InvC is their cosine
//   middle_i       0: s = 1/2, whatever the variant: of equal neighbours the middle is the normal itself
//   needs_d1_i     d1a of the line is below the threshold
//   threshold_i    S1.16, see shade_metric
//   factor_o       U0.18
//
// Latency LATENCY_FACTOR_S = 14 clocks, one pair a clock. Error: that of shade_invc. Source: P4, section 2, Table 1.
// Example: a = b, any variant -> 1/2.
module shade_factor (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  shade_pkg::vec_t                          a_i,
  input  shade_pkg::vec_t                          b_i,
  input  logic                                     middle_i,
  input  logic        [  shade_pkg::VARIANT_W-1:0] variant_i,
  input  logic                                     needs_d1_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] threshold_i,
  output logic        [     shade_pkg::INVC_F-1:0] factor_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int VARIANT_W = shade_pkg::VARIANT_W;

  logic signed [shade_pkg::DOT_W-1:0] dot;
  logic signed [W-1:0] cosine, threshold;
  shade_dot3 u_dot (
    .clk_i, .rst_i, .valid_i(1'b0), .ax_i(a_i.x), .ay_i(a_i.y), .az_i(a_i.z), .bx_i(b_i.x), .by_i(b_i.y), .bz_i(b_i.z),
    .valid_o(), .d_o(dot)
  );
  assign cosine = W'(dot);  // of unit vectors: within 1 + 4 ulp
  shade_delay #(.WIDTH(W), .DEPTH(shade_pkg::LATENCY_DOT3)) u_threshold (.clk_i, .d_i(threshold_i), .q_o(threshold));

  logic [shade_pkg::INVC_F-1:0] invc1, invc2, invc;
  shade_invc #(.FORM(shade_pkg::FORM_PAPER), .DEGREE(1)) u_invc1 (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(cosine), .valid_o(), .clamped_o(), .invc_o(invc1), .half_o()
  );
  shade_invc #(.FORM(shade_pkg::FORM_PAPER), .DEGREE(2)) u_invc2 (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(cosine), .valid_o(), .clamped_o(), .invc_o(invc2), .half_o()
  );
  shade_invc u_invc (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(cosine), .valid_o(), .clamped_o(), .invc_o(invc), .half_o()
  );

  logic needs_d2, needs_d2_f, needs_d1_f, middle_f;
  logic [VARIANT_W-1:0] variant_f;
  shade_metric u_metric (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(cosine), .m_i(shade_pkg::COUNT_W'(shade_pkg::METRIC_M_MIN)),
    .threshold_i(threshold), .valid_o(), .d1a_o(), .d2_o(), .needs_d1_o(), .needs_d2_o(needs_d2), .clamped_o(),
    .m_error_o(), .threshold_error_o()
  );
  shade_delay #(.WIDTH(1), .DEPTH(shade_pkg::LATENCY_INVC - shade_pkg::LATENCY_METRIC)) u_needs_d2 (
    .clk_i, .d_i(needs_d2), .q_o(needs_d2_f)
  );
  shade_ring #(.WIDTH(2 + VARIANT_W), .DEPTH(shade_pkg::LATENCY_FACTOR_S - 1)) u_choice (
    .clk_i, .rst_i, .d_i({middle_i, needs_d1_i, variant_i}), .q_o({middle_f, needs_d1_f, variant_f})
  );
  always_ff @(posedge clk_i) begin
    factor_o <= shade_pkg::INVC_F'(1 << (shade_pkg::INVC_F - 1));
    if (middle_f) begin
      case (variant_f)
        VARIANT_W'(shade_pkg::VARIANT_REFINED): factor_o <= invc;
        VARIANT_W'(shade_pkg::VARIANT_V1):      if (needs_d1_f) factor_o <= invc1;
        VARIANT_W'(shade_pkg::VARIANT_V2):      if (needs_d1_f) factor_o <= invc2;
        VARIANT_W'(shade_pkg::VARIANT_V4):      if (needs_d2_f) factor_o <= invc1;
        VARIANT_W'(shade_pkg::VARIANT_V5):      if (needs_d2_f) factor_o <= invc2;
        default: ;
      endcase
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, dot};
endmodule
