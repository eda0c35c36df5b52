// shade_paint: pixels of diffuse and specular light in, coloured pixels out, one a clock.
//
//   s_axis_pixel   tdata = {specular, diffuse}, U0.16; tuser = tag; tlast
//   m_axis_pixel   draw_i.control.colour = 1: tdata = {blue, green, red}, U0.16, see shade_colour; 0: {0, specular, diffuse}
//   draw_i         ambient_*, kd_*, ks_*, U1.16; must not change while a pixel is inside
//
// Six multipliers. The pipeline never stalls: a pixel is taken with a credit for its place in the FIFO behind; no
// combinational path leads from an input to an output. Latency LATENCY_PAINT clocks.
// Example: diffuse 1/2, ambient_r = 0.1, kd_r = 1 -> red 0.6. Source: P1, section II.
module shade_paint #(
  parameter int FIFO_LOG2 = shade_pkg::FIFO_LOG2
) (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  shade_pkg::draw_t                    draw_i,
  input  logic                                s_axis_pixel_tvalid,
  output logic                                s_axis_pixel_tready,
  input  logic [ shade_pkg::PIXEL_DATA_W-1:0] s_axis_pixel_tdata,
  input  logic [        shade_pkg::TAG_W-1:0] s_axis_pixel_tuser,
  input  logic                                s_axis_pixel_tlast,
  output logic                                m_axis_pixel_tvalid,
  input  logic                                m_axis_pixel_tready,
  output logic [shade_pkg::COLOUR_DATA_W-1:0] m_axis_pixel_tdata,
  output logic [        shade_pkg::TAG_W-1:0] m_axis_pixel_tuser,
  output logic                                m_axis_pixel_tlast
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int PIXEL_W = shade_pkg::PIXEL_W;
  localparam int DATA_W = shade_pkg::COLOUR_DATA_W;
  localparam int TAG_W = shade_pkg::TAG_W;

  logic take, taken;
  logic [FIFO_LOG2:0] credit_q, credit_d;
  assign take     = s_axis_pixel_tvalid && s_axis_pixel_tready;
  assign credit_d = credit_q + (FIFO_LOG2 + 1)'(taken) - (FIFO_LOG2 + 1)'(take);
  always_ff @(posedge clk_i) begin
    credit_q            <= credit_d;
    s_axis_pixel_tready <= credit_d != '0;
    if (rst_i) begin
      credit_q            <= (FIFO_LOG2 + 1)'(1 << FIFO_LOG2);
      s_axis_pixel_tready <= 1'b0;
    end
  end

  logic valid, last;
  logic [DATA_W-1:0] colour, plain;
  logic [TAG_W-1:0] tag;
  shade_colour u_colour (
    .clk_i, .rst_i, .valid_i(take),
    .diffuse_i({{(W - PIXEL_W) {1'b0}}, s_axis_pixel_tdata[0+:PIXEL_W]}),
    .specular_i({{(W - PIXEL_W) {1'b0}}, s_axis_pixel_tdata[PIXEL_W+:PIXEL_W]}),
    .ambient_r_i(draw_i.colour.ambient.r), .ambient_g_i(draw_i.colour.ambient.g), .ambient_b_i(draw_i.colour.ambient.b),
    .kd_r_i(draw_i.colour.kd.r), .kd_g_i(draw_i.colour.kd.g), .kd_b_i(draw_i.colour.kd.b),
    .ks_r_i(draw_i.colour.ks.r), .ks_g_i(draw_i.colour.ks.g), .ks_b_i(draw_i.colour.ks.b),
    .valid_o(valid), .r_o(colour[0+:PIXEL_W]), .g_o(colour[PIXEL_W+:PIXEL_W]), .b_o(colour[2*PIXEL_W+:PIXEL_W])
  );
  shade_delay #(.WIDTH(1 + TAG_W + DATA_W), .DEPTH(shade_pkg::LATENCY_COLOUR)) u_plain (
    .clk_i, .d_i({s_axis_pixel_tlast, s_axis_pixel_tuser, {PIXEL_W{1'b0}}, s_axis_pixel_tdata}),
    .q_o({last, tag, plain})
  );
  shade_fifo #(.WIDTH(1 + TAG_W + DATA_W), .LOG2(FIFO_LOG2)) u_fifo (
    .clk_i, .rst_i, .valid_i(valid), .data_i({last, tag, draw_i.control.colour ? colour : plain}),
    .valid_o(m_axis_pixel_tvalid), .ready_i(m_axis_pixel_tready),
    .data_o({m_axis_pixel_tlast, m_axis_pixel_tuser, m_axis_pixel_tdata}), .taken_o(taken)
  );

  logic unused_settings;
  assign unused_settings = &{1'b0, draw_i};
endmodule
