// SPDX-License-Identifier: Apache-2.0
// shade_patch_plan: how large the boxes of a triangle may be: 2^kx by 2^ky pixels, kx, ky 2 .. 4.
//
//   a_i, b_i   U3.18  norm of the normal's increment a column, a line;   far_i  S7.18  how far away the highlight is
//   columns_i, lines_i   of the triangle's box, 1 .. 4096; these stay until done_o
//   radius_i   U0.16  longest way of the normal from the middle of a box to a corner, sqrt(2 T / n)
//   reach_i    U3.16  how far away the highlight must be to count 1/4 as much, sqrt(4 / (0.72 n))
//   kx_o, ky_o, direct_o   direct: even 4 x 4 pixels are too curved, each is lit; until the next start_i
//
//   R = radius times 2 for each of far >= reach, 3/2 reach, 7/4 reach; at most PATCH_RADIUS
//   a 2^(kx-1) + b 2^(ky-1), the smaller halved, <= R      the side with the shorter way grows first, then the other
//
// So kappa = n (1 - cos) is weighed by the light, by shifts and adders. 4 clocks for at most 4 x 4 pixels, else 8, and 4 for each doubling.
// Source: P1's adaptive choice. Example: a = b = 0, 100 x 100 pixels -> kx = ky = 4.
module shade_patch_plan (
  input  logic                                           clk_i,
  input  logic                                           rst_i,
  input  logic        [     shade_pkg::INTENSITY_F-1:0]  radius_i,
  input  logic        [   shade_pkg::PATCH_REACH_W-1:0]  reach_i,
  input  logic                                           start_i,
  input  logic        [     shade_pkg::PATCH_WAY_W-1:0]  a_i,
  input  logic        [     shade_pkg::PATCH_WAY_W-1:0]  b_i,
  input  logic signed [     shade_pkg::PATCH_FAR_W-1:0]  far_i,
  input  logic        [         shade_pkg::COUNT_W-1:0]  columns_i,  // a clock behind start_i and on
  input  logic        [         shade_pkg::COUNT_W-1:0]  lines_i,
  output logic                                           done_o,
  output logic        [                           2:0]   kx_o,
  output logic        [                           2:0]   ky_o,
  output logic                                           direct_o
);
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int FAR_W = shade_pkg::PATCH_FAR_W;
  localparam int UP = shade_pkg::PATCH_PLAN_F - shade_pkg::INTENSITY_F;
  localparam int A_W = shade_pkg::PATCH_WAY_W + 3;  // a 2^(kx-1)
  localparam logic [2:0] MIN = 3'(shade_pkg::PATCH_LOG2_MIN);
  localparam logic [2:0] MAX = 3'(shade_pkg::PATCH_LOG2_MAX);

  typedef enum logic [2:0] {IDLE, SIZE, FLAT, FIT, WIDE, HIGH, WAIT, GROW} state_t;
  state_t state_q;

  // ---- radius ------------------------------------------------------------------------------------------------------------------
  localparam int R_W = shade_pkg::INTENSITY_F + 3;
  localparam int REACH_W = shade_pkg::PATCH_REACH_W + UP;
  logic [REACH_W-1:0] reach;
  logic [REACH_W:0] once, twice;
  logic [1:0] passes_q;
  logic [R_W-1:0] radius, radius_q;
  assign reach  = {reach_i, {UP{1'b0}}};
  assign once   = (REACH_W + 1)'(reach) + (REACH_W + 1)'(reach >> 1);
  assign twice  = {reach, 1'b0} - (REACH_W + 1)'(reach >> 2);
  assign radius = R_W'(radius_i) << passes_q;
  always_ff @(posedge clk_i) begin
    if (state_q == IDLE) passes_q <= 2'(far_i >= $signed(FAR_W'(reach))) + 2'(far_i >= $signed(FAR_W'(once))) +
                2'(far_i >= $signed(FAR_W'(twice)));
    radius_q <= radius > R_W'(shade_pkg::PATCH_RADIUS) ? R_W'(shade_pkg::PATCH_RADIUS) : radius;
  end

  // ---- sizes: one comparison of most + least / 2 <= R in three clocks, for a box twice as wide, then for one twice as high -----------
  logic [A_W-1:0] a_q, b_q;
  logic [A_W:0] wide, high, most_q, least_q, sum_q;
  logic fits, wide_fits_q, may_x_q, may_y_q, grows_x, grows_y, more;
  assign wide    = state_q == HIGH ? {1'b0, a_q} : {a_q, 1'b0};
  assign high    = state_q == HIGH ? {b_q, 1'b0} : {1'b0, b_q};
  assign fits    = sum_q <= (A_W + 1)'({radius_q, {UP{1'b0}}});
  assign more    = (kx_o < MAX && may_x_q) || (ky_o < MAX && may_y_q);
  assign grows_x = wide_fits_q && may_x_q && (a_q <= b_q || !(fits && may_y_q));
  assign grows_y = fits && may_y_q && !grows_x;
  always_ff @(posedge clk_i) begin
    most_q  <= wide > high ? wide : high;
    least_q <= wide > high ? high : wide;
    sum_q   <= most_q + (least_q >> 1);  // what overflows is not reached: a, b < 2^A_W / 2
    may_x_q <= kx_o < MAX && columns_i > COUNT_W'(1) << kx_o;
    may_y_q <= ky_o < MAX && lines_i > COUNT_W'(1) << ky_o;
    done_o  <= 1'b0;
    case (state_q)
      IDLE: begin
        a_q  <= A_W'(a_i);
        b_q  <= A_W'(b_i) << 1;
        kx_o <= start_i ? MIN : kx_o;
        ky_o <= start_i ? MIN : ky_o;
        if (start_i) state_q <= SIZE;
      end
      SIZE:  state_q <= FLAT;
      FLAT:  state_q <= FIT;
      FIT: begin
        a_q      <= a_q << 1;
        direct_o <= !fits;
        done_o   <= !more;
        state_q  <= more ? WIDE : IDLE;
      end
      WIDE:  state_q <= HIGH;
      HIGH:  state_q <= WAIT;
      WAIT: begin
        wide_fits_q <= fits;
        state_q     <= GROW;
      end
      GROW: begin
        if (grows_x) a_q <= a_q << 1;
        if (grows_y) b_q <= b_q << 1;
        kx_o    <= kx_o + 3'(grows_x);
        ky_o    <= ky_o + 3'(grows_y);
        done_o  <= !grows_x && !grows_y;
        state_q <= grows_x || grows_y ? WIDE : IDLE;
      end
    endcase
    if (rst_i) begin
      state_q <= IDLE;
      done_o  <= 1'b0;
    end
  end
endmodule
