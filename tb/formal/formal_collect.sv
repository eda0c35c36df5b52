// formal_collect: shade_collect gives a record a clock after its last node, with the light that came for each node.
//
// A free constant chooses one slot, another one bit of both lights: what is true of it is true of all.
module formal_collect (
  input logic        clk_i,
  input logic        rst_i,
  input logic        valid_i,
  input logic [17:0] diffuse_i,
  input logic [17:0] specular_i,
  input logic [ 1:0] slot_i,
  input logic        shared_i,
  input logic        last_i,
  input logic [12:0] count_i,
  input logic [ 1:0] degree_i,
  input logic        more_i,
  input logic [15:0] tag_i,
  input logic [ 1:0] chosen_i,
  input logic [ 4:0] bit_i
);
  localparam int W = shade_pkg::INTENSITY_W;
  logic valid;
  logic [shade_pkg::SPAN_DATA_W-1:0] record;
  shade_collect u_dut (
    .clk_i, .rst_i, .valid_i, .diffuse_i, .specular_i, .slot_i, .shared_i, .last_i, .count_i, .degree_i, .more_i,
    .tag_i, .valid_o(valid), .record_o(record)
  );

  logic started_q = 1'b0;
  logic last_q, more_q, known_q, diffuse_q, specular_q, before_known_q;
  logic [1:0] chosen_q, before_q, degree_q;
  logic [4:0] bit_q;
  logic [12:0] count_q;
  logic [15:0] tag_q;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    if (!started_q) {chosen_q, bit_q} <= {chosen_i, bit_i};
    last_q <= valid_i && last_i;
    if (valid_i) begin
      {more_q, degree_q, count_q, tag_q} <= {more_i, degree_i, count_i, tag_i};
      before_known_q <= 1'b1;
      before_q <= {specular_i[bit_q], diffuse_i[bit_q]};
      if (slot_i == chosen_q) begin
        known_q <= 1'b1;
        {specular_q, diffuse_q} <= {specular_i[bit_q], diffuse_i[bit_q]};
      end else if (shared_i && chosen_q == 2'd0) begin
        known_q <= before_known_q;
        {specular_q, diffuse_q} <= before_q;
      end
    end
    if (rst_i) {last_q, known_q, before_known_q} <= '0;
  end

  logic [W-1:0] diffuse, specular;
  assign diffuse  = record[W*chosen_q+:W];
  assign specular = record[W*(shade_pkg::NODE_COUNT+chosen_q)+:W];
  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    // A bit of an intensity, chosen once.
    if (started_q) one_of_its_bits : assume (bit_q < 5'd18);
    if (started_q) begin
      // A record comes a clock after its last node, and at no other time.
      // mutant: valid_o <= valid_i && last_i => valid_o <= valid_i
      in_time : assert (valid == last_q);
      // Each slot holds the light of the node that came last for it; slot 0 of a shared node that of the node before.
      // mutant: valid_i && shared_i && slot == 0 => valid_i && shared_i && slot == 1
      light : assert (!(valid && known_q) || (diffuse[bit_q] == diffuse_q && specular[bit_q] == specular_q));
      // The record's own fields are those that came with its last node.
      // mutant: <= more_i => <= !more_i
      fields : assert (
        !valid || (record[shade_pkg::SPAN_COUNT_LSB+:13] == count_q && record[shade_pkg::SPAN_DEGREE_LSB+:2] == degree_q
        && record[shade_pkg::SPAN_MORE] == more_q && record[shade_pkg::SPAN_TAG_LSB+:16] == tag_q)
      );
    end
  end
endmodule
