// SPDX-License-Identifier: Apache-2.0
// shade_metric: the length that the middle of two unit normals has before it is normalized, by P4's two estimates.
//
//   d1a = 0.06 c + 0.007 m + 0.894      cos(x/m): c = cos x of the ends of a line of m sectors, m = 3 .. 12
//   d2  = 0.25 c + 0.75, where c <= cos(pi/4) 0.305 c + 0.712      cos(x/2): c = cos x of the two neighbours
//
//   c_i          S1.16, clamped to [0, 1]: clamped
//   m_i          U13.0, clamped to 3 .. 12: m_error
//   threshold_i  S1.16, METRIC_THRESHOLD = 0.9 in the paper; clamped to [0, 1]: threshold_error
//   d1a, d2      S1.16, constants of 16 fraction bits, to nearest, ties up: error at most 1/2 ulp; with the
//                constants as the paper prints them 3.3 ulp (d1a), 0.9 ulp (d2)
//   needs_d1, needs_d2   d1a, d2 below the threshold: the middle must be normalized
//
// All flags come with the result. (d1a is never below 0.915: with the paper's threshold needs_d1 stays 0.)
// Shifts and adds. Latency LATENCY_METRIC = 7 clocks, one pair a clock. Source: P4, section 2.
// Example: c = 1/2, m = 4, threshold 0.9 -> d1a = 0.952, d2 = 0.8645, needs_d1 = 0, needs_d2 = 1.
module shade_metric (
  input  logic                                     clk_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] c_i,
  input  logic        [    shade_pkg::COUNT_W-1:0] m_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] threshold_i,
  output shade_pkg::metric_t                       metric_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int M_W = shade_pkg::COUNT_W;
  localparam int LATENCY = shade_pkg::LATENCY_METRIC;
  localparam logic [M_W-1:0] M_MIN = M_W'(shade_pkg::METRIC_M_MIN);
  localparam logic [M_W-1:0] M_MAX = M_W'(shade_pkg::METRIC_M_MAX);

  logic [F:0] share, c_q1, threshold, threshold_q1, threshold_q6;
  logic [3:0] m_q1;
  logic clamped, threshold_error;
  logic [2:0] flags_q1;
  shade_clamp u_c (.x_i(c_i), .y_o(share), .clamped_o(clamped));
  shade_clamp u_threshold (.x_i(threshold_i), .y_o(threshold), .clamped_o(threshold_error));
  always_ff @(posedge clk_i) begin
    c_q1         <= share;
    threshold_q1 <= threshold;
    m_q1         <= m_i < M_MIN ? 4'(M_MIN) : m_i > M_MAX ? 4'(M_MAX) : 4'(m_i);
    flags_q1     <= {clamped, m_i < M_MIN || m_i > M_MAX, threshold_error};
  end

  // m 2^16 and c in one format, S4.16
  localparam int WIDTH = F + 5;
  logic [F:0] c_q2;
  logic [3:0] m_q2;
  logic signed [WIDTH-1:0] c, m, none;
  assign c    = WIDTH'({1'b0, c_q2});
  assign m    = {1'b0, m_q2, {F{1'b0}}};
  assign none = '0;
  logic signed [W-1:0] d1a_q6, d2_q6;
  always_ff @(posedge clk_i) begin
    c_q2 <= c_q1;
    m_q2 <= m_q1;
  end
  shade_weigh #(
    .WIDTH(WIDTH), .F(F), .K0(shade_pkg::D1_0), .KX(shade_pkg::D1_C), .KY(shade_pkg::D1_M)
  ) u_d1a (.clk_i, .x_i(c), .y_i(m), .z_i(none), .w_o(d1a_q6));
  shade_half #(.FORM(shade_pkg::FORM_PAPER)) u_d2 (
    .clk_i, .c_i(c_q1), .uu_i('0), .uuuu_i('0), .half_o(d2_q6)
  );

  shade_delay #(.WIDTH(F + 1), .DEPTH(LATENCY - 2)) u_wait (.clk_i, .d_i(threshold_q1), .q_o(threshold_q6));
  always_ff @(posedge clk_i) begin
    metric_o.d1a      <= d1a_q6;
    metric_o.d2       <= d2_q6;
    metric_o.needs_d1 <= d1a_q6 < $signed({1'b0, threshold_q6});
    metric_o.needs_d2 <= d2_q6 < $signed({1'b0, threshold_q6});
  end

  shade_delay #(.WIDTH(3), .DEPTH(LATENCY - 1)) u_flags (
    .clk_i, .d_i(flags_q1), .q_o({metric_o.clamped, metric_o.m_error, metric_o.threshold_error})
  );
endmodule
