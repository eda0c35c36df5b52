// shade_collect: the light at the nodes of a record, one node after the other, into a record of shade_poly_span.
//
//   diffuse_i, specular_i  S1.16, light at node slot_i of its record; a record's nodes come in rising order
//   shared_i   first of a record whose slot 0 is the node that came last, not sent again
//   last_i     the record is complete
//   count_i, degree_i, more_i, tag_i   of the record, taken with its last node
//   record_o   SPAN packet, see shade_span_walk; slots that the degree does not use hold what they held
//
// Latency LATENCY_COLLECT = 1 clock from a record's last node, one node a clock. Exact.
// Example: degree 1: (slot 0: 1/4, 1/8), (slot 1: 1/2, 1/8, last) -> nodes 1/4, 1/2 diffuse, 1/8, 1/8 specular.
module shade_collect (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] diffuse_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] specular_i,
  input  logic        [                       1:0] slot_i,
  input  logic                                     shared_i,
  input  logic                                     last_i,
  input  logic        [    shade_pkg::COUNT_W-1:0] count_i,
  input  logic        [   shade_pkg::DEGREE_W-1:0] degree_i,
  input  logic                                     more_i,
  input  logic        [      shade_pkg::TAG_W-1:0] tag_i,
  output logic                                     valid_o,
  output logic        [shade_pkg::SPAN_DATA_W-1:0] record_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int NODES = shade_pkg::NODE_COUNT;

  logic [shade_pkg::CHANNELS*W-1:0] light, before_q;
  assign light = {specular_i, diffuse_i};
  always_ff @(posedge clk_i) if (valid_i) before_q <= light;

  for (genvar c = 0; c < shade_pkg::CHANNELS; c++) begin : g_channel
    for (genvar slot = 0; slot < NODES; slot++) begin : g_slot
      localparam int LSB = W * (NODES * c + slot);
      always_ff @(posedge clk_i) begin
        if (valid_i && slot_i == 2'(slot)) record_o[LSB+:W] <= light[c*W+:W];
        else if (valid_i && shared_i && slot == 0) record_o[LSB+:W] <= before_q[c*W+:W];
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      record_o[shade_pkg::SPAN_DATA_W-1:shade_pkg::SPAN_COUNT_LSB]              <= '0;
      record_o[shade_pkg::SPAN_COUNT_LSB+:shade_pkg::COUNT_W]                   <= count_i;
      record_o[shade_pkg::SPAN_MORE]                                        <= more_i;
      record_o[shade_pkg::SPAN_DEGREE_LSB+:shade_pkg::DEGREE_W]                 <= degree_i;
      record_o[shade_pkg::SPAN_TAG_LSB+:shade_pkg::TAG_W]                       <= tag_i;
    end
    valid_o <= valid_i && last_i;
    if (rst_i) valid_o <= 1'b0;
  end
endmodule
