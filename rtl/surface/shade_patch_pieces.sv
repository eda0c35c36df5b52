// SPDX-License-Identifier: Apache-2.0
// shade_patch_pieces: from the light at nodes and the pixels of boxes to pieces of lines for shade_patch_lane.
//
//   meta_*, light_*, token_*   {deep, kx, ky, column, line, tag} of shade_patch_nodes, {specular, diffuse} of shade_patch_light, and
//               those of shade_patch_clip, from FIFOs
//   room_i      stops the walk over lines; up to LATENCY_PATCH_LINES + 1 pieces still come
//   place_o     {count - 1, column, line, tag} of a piece, LATENCY_PATCH_LINES clocks in front of
//   value_o     {specular d2, d1, I, diffuse d2, d1, I}: see shade_patch_lines
//
// A box's nodes are taken while the lines of the one before it are drawn. A line and a light a clock; an empty line above others costs as much.
// Example: a box of 4 x 4 with 7 pixels in two lines -> six lights taken, two pieces.
module shade_patch_pieces (
  input  logic                                  clk_i,
  input  logic                                  rst_i,
  input  logic                                  meta_valid_i,
  output logic                                  meta_ready_o,
  input  logic [  shade_pkg::PATCH_META_W-2:0]  meta_i,
  input  logic                                  light_valid_i,
  output logic                                  light_ready_o,
  input  logic [2*shade_pkg::INTENSITY_W-1:0]   light_i,
  input  logic                                  token_valid_i,
  output logic                                  token_ready_o,
  input  logic [2*shade_pkg::PATCH_TOKEN_W-1:0] token_i,
  input  logic                                  room_i,
  output logic                                  place_valid_o,
  output logic [ shade_pkg::PATCH_AREA_W-1:0]   place_o,
  output logic                                  value_valid_o,
  output logic [6*shade_pkg::PATCH_VALUE_W-1:0] value_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int VALUE_W = shade_pkg::PATCH_VALUE_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int LATENCY = shade_pkg::LATENCY_PATCH_LINES;
  localparam int LATE = shade_pkg::PATCH_LINES_LATE;
  localparam int BOX_W = LOG2 + 6 + 2 * PLACE_W + TAG_W;

  // ---- nodes: six of a box -----------------------------------------------------------------------------------------------------
  logic node, whole, free_q, load_q, waits_q, load, step, done;
  logic [2:0] node_q;
  logic [LATE-1:0] loads_q, steps_q;
  logic [BOX_W-1:0] coming_q, box_q;
  // the last nodes of a box when there is room for its coefficients
  assign node          = meta_valid_i && light_valid_i && (!node_q[2] || free_q || loads_q[LATE-1]);
  assign whole         = node && node_q == 3'd5;
  assign light_ready_o = node;
  assign meta_ready_o  = whole;
  always_ff @(posedge clk_i) begin
    if (node) node_q <= whole ? 3'd0 : node_q + 3'd1;
    if (whole) coming_q <= meta_i;
    load_q <= whole;
    if (load_q) waits_q <= 1'b1;
    else if (load) waits_q <= 1'b0;
    if (whole) free_q <= 1'b0;
    else if (loads_q[LATE-1]) free_q <= 1'b1;
    if (rst_i) begin
      node_q  <= '0;
      load_q  <= 1'b0;
      waits_q <= 1'b0;
      free_q  <= 1'b1;
    end
  end

  // ---- lines of a box ----------------------------------------------------------------------------------------------------------
  localparam int TOKEN_W = shade_pkg::PATCH_TOKEN_W;
  logic busy_q, empty, odd_q;
  logic [LOG2-1:0] deep_q, deep, first;
  logic [LOG2:0] count;
  logic [2:0] kx, ky, coming_kx, coming_ky;
  logic [PLACE_W-1:0] column, line, line_q;
  logic [TAG_W-1:0] tag;
  logic [1:0] jx, jy, jy_late;
  logic [LOG2-1:0] coming_deep;
  logic [PLACE_W-1:0] coming_column, coming_line;
  logic [TAG_W-1:0] coming_tag;
  assign {coming_deep, coming_kx, coming_ky, coming_column, coming_line, coming_tag} = coming_q;
  assign {deep, kx, ky, column, line, tag} = box_q;
  assign {first, count} = odd_q ? token_i[TOKEN_W+:TOKEN_W] : token_i[0+:TOKEN_W];
  assign empty         = count == '0;
  assign step          = busy_q && token_valid_i && room_i;
  assign token_ready_o = step && (odd_q || done);
  assign done          = step && deep_q == '0;
  assign load          = waits_q && (!busy_q || done);
  assign jx            = 2'(3'd4 - kx);
  assign jy            = 2'(3'd4 - coming_ky);
  always_ff @(posedge clk_i) begin
    if (load) begin
      box_q  <= coming_q;
      deep_q <= coming_deep;
      line_q <= coming_line;
    end else if (step) begin
      deep_q <= deep_q - LOG2'(1);
      line_q <= line_q + PLACE_W'(1);
    end
    if (load) busy_q <= 1'b1;
    else if (done) busy_q <= 1'b0;
    loads_q   <= {loads_q[LATE-2:0], load};
    steps_q   <= {steps_q[LATE-2:0], step};
    if (load || done) odd_q <= 1'b0;
    else if (step) odd_q <= !odd_q;
    if (rst_i) begin
      busy_q    <= 1'b0;
      loads_q   <= '0;
    end
  end
  shade_delay #(.WIDTH(2), .DEPTH(LATE)) u_jy (.clk_i, .d_i(jy), .q_o(jy_late));

  always_ff @(posedge clk_i) begin
    place_valid_o <= step && !empty && !rst_i;
    place_o       <= {LOG2'(count - (LOG2 + 1)'(1)), column + PLACE_W'(first), line_q, tag};
  end

  // ---- values ------------------------------------------------------------------------------------------------------------------
  logic signed [LOG2-1:0] x;
  assign x = (first << jx) ^ LOG2'(8);

  for (genvar c = 0; c < 2; c++) begin : g_channel
    logic signed [VALUE_W-1:0] a, b, u;
    logic signed [W-1:0] p;
    logic signed [W-3:0] q;
    logic signed [W-2:0] r;
    shade_patch_coef u_coef (
      .clk_i, .valid_i(node), .node_i(node_q), .light_i(light_i[c*W+:W]), .load_i(load_q), .a_o(a), .b_o(b),
      .u_o(u), .p_o(p), .q_o(q), .r_o(r)
    );
    shade_patch_lines u_lines (
      .clk_i, .a_i(a), .b_i(b), .u_i(u), .p_i(p), .q_i(q), .r_i(r), .load_i(load), .load_late_i(loads_q[LATE-1]),
      .jy_i(jy), .jy_late_i(jy_late), .step_i(step), .step_late_i(steps_q[LATE-1]), .x_i(x), .jx_i(jx),
      .first_o(value_o[c*3*VALUE_W+:VALUE_W]), .d1_o(value_o[(c*3+1)*VALUE_W+:VALUE_W]),
      .d2_o(value_o[(c*3+2)*VALUE_W+:VALUE_W])
    );
  end
  shade_valid #(.DEPTH(LATENCY)) u_valid (
    .clk_i, .rst_i, .valid_i(step && !empty), .valid_o(value_valid_o)
  );
  logic unused_deep;
  assign unused_deep = &{1'b0, coming_kx, coming_column, deep, ky, line, coming_tag};
endmodule
