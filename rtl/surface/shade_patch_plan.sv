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
// So kappa = n (1 - cos) is weighed by the light, by shifts and adders. 5 clocks, one more for each doubling.
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

  typedef enum logic [1:0] {IDLE, SIZE, FLAT, GROW} state_t;
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
    passes_q <= 2'(far_i >= $signed(FAR_W'(reach))) + 2'(far_i >= $signed(FAR_W'(once))) +
                2'(far_i >= $signed(FAR_W'(twice)));
    radius_q <= radius > R_W'(shade_pkg::PATCH_RADIUS) ? R_W'(shade_pkg::PATCH_RADIUS) : radius;
  end

  // ---- sizes -------------------------------------------------------------------------------------------------------------------
  function automatic logic fits(input logic [A_W:0] a, input logic [A_W:0] b, input logic [R_W-1:0] r);
    logic [A_W:0] most, least;
    most  = a > b ? a : b;
    least = a > b ? b : a;
    fits  = (A_W + 2)'(most) + (A_W + 2)'(least >> 1) <= (A_W + 2)'({r, {UP{1'b0}}});
  endfunction
  logic [A_W-1:0] a_q, b_q;
  logic wide_fits, may_x, may_y, grows_x, grows_y;
  assign wide_fits = fits({a_q, 1'b0}, {1'b0, b_q}, radius_q);
  assign may_x     = wide_fits && kx_o < MAX && columns_i > COUNT_W'(1) << kx_o;
  assign may_y     = fits({1'b0, a_q}, {b_q, 1'b0}, radius_q) && ky_o < MAX && lines_i > COUNT_W'(1) << ky_o;
  assign grows_x   = may_x && (a_q <= b_q || !may_y);
  assign grows_y   = may_y && !grows_x;
  always_ff @(posedge clk_i) begin
    case (state_q)
      IDLE: begin
        a_q  <= A_W'(a_i);
        b_q  <= A_W'(b_i) << 1;
        kx_o <= start_i ? MIN : kx_o;
        ky_o <= start_i ? MIN : ky_o;
        if (start_i) state_q <= SIZE;
      end
      SIZE: state_q <= FLAT;
      FLAT: begin
        a_q      <= a_q << 1;
        direct_o <= !wide_fits;
        state_q  <= GROW;
      end
      GROW: begin
        if (grows_x) a_q <= a_q << 1;
        if (grows_y) b_q <= b_q << 1;
        kx_o <= kx_o + 3'(grows_x);
        ky_o <= ky_o + 3'(grows_y);
        if (!grows_x && !grows_y) state_q <= IDLE;
      end
    endcase
    done_o <= state_q == GROW && !grows_x && !grows_y;
    if (rst_i) begin
      state_q <= IDLE;
      done_o  <= 1'b0;
    end
  end
endmodule
