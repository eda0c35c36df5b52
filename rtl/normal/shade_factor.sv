// SPDX-License-Identifier: Apache-2.0
// shade_factor: what the sum of two unit normals is multiplied by to get the normal in their middle, by P4's variants.
//
//   choice_i.variant   s
//   VARIANT_REFINED    InvC, anchored            VARIANT_V1, _V2   InvC1, InvC2 where needs_d1, else 1/2
//   VARIANT_V3, _V6    1/2, the mean             VARIANT_V4, _V5   InvC1, InvC2 where d2 < threshold, else 1/2
//
//   a_i, b_i       S1.16, the two neighbours; c of d2 and InvC is their cosine
//   choice_i       middle = 0: s = 1/2, whatever the variant: of equal neighbours the middle is the normal itself;
//                  needs_d1: d1a of the line is below the threshold; threshold: S1.16, see shade_metric
//   factor_o       U0.18
//
// Latency LATENCY_FACTOR_S = 14 clocks, one pair a clock. Error: that of shade_invc. Source: P4, section 2, Table 1.
// Example: a = b, any variant -> 1/2.
module shade_factor (
  input  logic                         clk_i,
  input  logic                         rst_i,
  input  shade_pkg::vec_t              a_i,
  input  shade_pkg::vec_t              b_i,
  input  shade_pkg::choice_t           choice_i,
  output logic [shade_pkg::INVC_F-1:0] factor_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int VARIANT_W = shade_pkg::VARIANT_W;

  logic signed [shade_pkg::DOT_W-1:0] dot;
  logic signed [W-1:0] cosine, threshold;
  shade_dot3 u_dot (.clk_i, .a_i, .b_i, .d_o(dot));
  assign cosine = W'(dot);  // of unit vectors: within 1 + 4 ulp
  shade_delay #(.WIDTH(W), .DEPTH(shade_pkg::LATENCY_DOT3)) u_threshold (
    .clk_i, .d_i(choice_i.threshold), .q_o(threshold)
  );

  shade_pkg::invc_t invc1, invc2, invc;
  shade_invc #(.FORM(shade_pkg::FORM_PAPER), .DEGREE(1)) u_invc1 (.clk_i, .c_i(cosine), .invc_o(invc1));
  shade_invc #(.FORM(shade_pkg::FORM_PAPER), .DEGREE(2)) u_invc2 (.clk_i, .c_i(cosine), .invc_o(invc2));
  shade_invc u_invc (.clk_i, .c_i(cosine), .invc_o(invc));

  logic needs_d2_f;
  shade_pkg::metric_t metric;
  shade_pkg::choice_t choice;
  shade_metric u_metric (
    .clk_i, .c_i(cosine), .m_i(shade_pkg::COUNT_W'(shade_pkg::METRIC_M_MIN)), .threshold_i(threshold), .metric_o(metric)
  );
  shade_delay #(.WIDTH(1), .DEPTH(shade_pkg::LATENCY_INVC - shade_pkg::LATENCY_METRIC)) u_needs_d2 (
    .clk_i, .d_i(metric.needs_d2), .q_o(needs_d2_f)
  );
  shade_ring #(.WIDTH($bits(choice)), .DEPTH(shade_pkg::LATENCY_FACTOR_S - 1)) u_choice (
    .clk_i, .rst_i, .d_i(choice_i), .q_o(choice)
  );
  always_ff @(posedge clk_i) begin
    factor_o <= shade_pkg::INVC_F'(1 << (shade_pkg::INVC_F - 1));
    if (choice.middle) begin
      case (choice.variant)
        VARIANT_W'(shade_pkg::VARIANT_REFINED): factor_o <= invc.invc;
        VARIANT_W'(shade_pkg::VARIANT_V1):      if (choice.needs_d1) factor_o <= invc1.invc;
        VARIANT_W'(shade_pkg::VARIANT_V2):      if (choice.needs_d1) factor_o <= invc2.invc;
        VARIANT_W'(shade_pkg::VARIANT_V4):      if (needs_d2_f) factor_o <= invc1.invc;
        VARIANT_W'(shade_pkg::VARIANT_V5):      if (needs_d2_f) factor_o <= invc2.invc;
        default: ;
      endcase
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, dot, invc, invc1, invc2, metric, choice};
endmodule
