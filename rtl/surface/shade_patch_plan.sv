// SPDX-License-Identifier: Apache-2.0
// shade_patch_plan: how large the boxes of a triangle may be: 2^kx by 2^ky pixels, kx, ky 2 .. 4.
//
//   valid_i, take_o   what shade_patch_far has found of a triangle
//   radius_i   U0.16  longest way of the normal from the middle of a box to a corner, sqrt(2 T / n)
//   reach_i    U3.16  how far away the highlight must be to count 1/4 as much, sqrt(4 / (0.72 n))
//   valid_o, plan_o   {direct, kx, ky} for one clock; direct: even 4 x 4 pixels are too curved, each is lit
//
//   R = radius times 2 for each of away - half >= reach, 3/2 reach, 7/4 reach; at most PATCH_RADIUS
//   a 2^(kx-2) + b 2^(ky-2), the smaller halved, <= R      the side with the shorter way grows first, then the other
//
// A side does not grow beyond that of its triangle, nor beyond 2^(exp + 2) of its increment, which a normalized one does not
// need. So kappa = n (1 - cos) is weighed by the light, by shifts and adders. 7 clocks, 4 more for each doubling and the last try.
// Source: P1's adaptive choice. Example: a = b = 0, exp 15, 100 x 100 pixels -> kx = ky = 4.
module shade_patch_plan (
  input  logic                                    clk_i,
  input  logic                                    rst_i,
  input  logic [      shade_pkg::INTENSITY_F-1:0] radius_i,
  input  logic [    shade_pkg::PATCH_REACH_W-1:0] reach_i,
  input  logic                                    valid_i,
  output logic                                    take_o,
  input  logic [     shade_pkg::PATCH_PLAN_F-1:0] a_i,
  input  logic [     shade_pkg::PATCH_PLAN_F-1:0] b_i,
  input  logic [     shade_pkg::PATCH_AWAY_W-1:0] away_i,
  input  logic [     shade_pkg::PATCH_AWAY_W-1:0] half_i,
  input  logic [          shade_pkg::COUNT_W-1:0] columns_i,
  input  logic [          shade_pkg::COUNT_W-1:0] lines_i,
  input  logic [   shade_pkg::TRIANGLE_EXP_W-1:0] column_exp_i,
  input  logic [   shade_pkg::TRIANGLE_EXP_W-1:0] line_exp_i,
  output logic                                    valid_o,
  output logic [     shade_pkg::PATCH_PLAN_W-1:0] plan_o
);
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int CUT = shade_pkg::INTENSITY_F - shade_pkg::PATCH_PLAN_F;
  localparam int A_W = shade_pkg::PATCH_PLAN_F + 2;  // of a box of 16 pixels
  localparam int R_W = shade_pkg::INTENSITY_F + 3;
  localparam int FAR_W = shade_pkg::PATCH_AWAY_W + 1;
  localparam logic [2:0] MIN = 3'(shade_pkg::PATCH_LOG2_MIN);
  localparam logic [2:0] MAX = 3'(shade_pkg::PATCH_LOG2_MAX);

  typedef enum logic [3:0] {IDLE, ONCE, TWICE, THRICE, LAST, FLAT, FIT, WIDE, HIGH, WAIT, GROW} state_t;
  state_t state_q;
  assign take_o = state_q == IDLE && valid_i;

  // ---- radius: away - half, less reach, reach / 2, reach / 4 -----------------------------------------------------------------
  logic signed [FAR_W-1:0] far_q, from, less;
  logic [1:0] passes_q;
  logic [R_W-1:0] radius;
  logic [shade_pkg::PATCH_PLAN_F-1:0] radius_q;
  logic beyond;
  assign from   = state_q == IDLE ? FAR_W'(away_i) : far_q;
  assign less   = state_q == IDLE ? FAR_W'(half_i) : FAR_W'(reach_i >> (state_q == ONCE ? 0 : state_q == TWICE ? 1 : 2));
  assign beyond = !far_q[FAR_W-1];
  assign radius = R_W'(radius_i) << passes_q;
  always_ff @(posedge clk_i) begin
    far_q    <= from - less;
    passes_q <= state_q == ONCE ? '0 : passes_q + 2'(beyond && (state_q == TWICE || state_q == THRICE || state_q == LAST));
    radius_q <= (shade_pkg::PATCH_PLAN_F)'((radius > R_W'(shade_pkg::PATCH_RADIUS) ? R_W'(shade_pkg::PATCH_RADIUS) : radius) >> CUT);
  end

  // ---- sizes: one comparison of most + least / 2 <= R in three clocks, for a box twice as wide, then for one twice as high -----
  logic [2:0] kx_q, ky_q;
  logic direct_q;
  logic [COUNT_W-1:0] columns_q, lines_q;
  logic [shade_pkg::TRIANGLE_EXP_W-1:0] column_exp_q, line_exp_q;
  logic [A_W-1:0] a_q, b_q;
  logic [A_W:0] wide, high, most_q, least_q, sum_q;
  logic fits, wide_fits_q, may_x_q, may_y_q, grows_x, grows_y, more;
  assign wide    = state_q == WIDE ? {a_q, 1'b0} : {1'b0, a_q};
  assign high    = state_q == HIGH ? {b_q, 1'b0} : {1'b0, b_q};
  assign fits    = sum_q <= (A_W + 1)'(radius_q);
  assign more    = may_x_q || may_y_q;
  assign grows_x = wide_fits_q && may_x_q && (a_q <= b_q || !(fits && may_y_q));
  assign grows_y = fits && may_y_q && !grows_x;
  assign plan_o  = {direct_q, kx_q, ky_q};
  always_ff @(posedge clk_i) begin
    most_q  <= wide > high ? wide : high;
    least_q <= wide > high ? high : wide;
    sum_q   <= most_q + (least_q >> 1);
    may_x_q <= kx_q < MAX && columns_q > COUNT_W'(1) << kx_q && 5'(kx_q) < 5'(column_exp_q) + 5'd2;
    may_y_q <= ky_q < MAX && lines_q > COUNT_W'(1) << ky_q && 5'(ky_q) < 5'(line_exp_q) + 5'd2;
    valid_o <= 1'b0;
    case (state_q)
      IDLE: begin
        a_q <= A_W'(a_i);
        b_q <= A_W'(b_i);
        {columns_q, lines_q, column_exp_q, line_exp_q} <= {columns_i, lines_i, column_exp_i, line_exp_i};
        if (valid_i) begin
          {kx_q, ky_q} <= {MIN, MIN};
          state_q      <= ONCE;
        end
      end
      FIT: begin
        direct_q <= !fits;
        valid_o  <= !more;
        state_q  <= more ? WIDE : IDLE;
      end
      WAIT: begin
        wide_fits_q <= fits;
        state_q     <= GROW;
      end
      GROW: begin
        if (grows_x) a_q <= a_q << 1;
        if (grows_y) b_q <= b_q << 1;
        kx_q    <= kx_q + 3'(grows_x);
        ky_q    <= ky_q + 3'(grows_y);
        valid_o <= !grows_x && !grows_y;
        state_q <= grows_x || grows_y ? WIDE : IDLE;
      end
      default: state_q <= state_t'(state_q + 4'd1);
    endcase
    if (rst_i) begin
      state_q <= IDLE;
      valid_o <= 1'b0;
    end
  end
endmodule
