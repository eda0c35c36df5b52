// SPDX-License-Identifier: Apache-2.0
// formal_collect: shade_collect gives a record a clock after its last node, with the light that came for each node.
//
// A free constant chooses one slot, another one bit of both lights: what is true of it is true of all.
module formal_collect (
  input logic        clk_i,
  input logic        rst_i,
  input logic        valid_i,
  input logic [35:0] light_i,  // intensity_t
  input logic [shade_pkg::PLACE_BITS-1:0] place_i,
  input logic [ 1:0] chosen_i,
  input logic [ 4:0] bit_i
);
  localparam int W = shade_pkg::INTENSITY_W;
  logic valid;
  shade_pkg::record_t record;
  shade_pkg::intensity_t lit;
  shade_pkg::place_t place;
  assign lit   = light_i;
  assign place = place_i;
  shade_collect u_dut (
    .clk_i, .rst_i, .valid_i, .light_i(lit), .place_i(place), .valid_o(valid), .record_o(record)
  );

  logic started_q = 1'b0;
  logic last_q, known_q, diffuse_q, specular_q, before_known_q;
  logic [1:0] chosen_q, before_q;
  logic [4:0] bit_q;
  shade_pkg::head_t head_q;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    if (!started_q) {chosen_q, bit_q} <= {chosen_i, bit_i};
    last_q <= valid_i && place.last;
    if (valid_i) begin
      head_q <= place.head;
      before_known_q <= 1'b1;
      before_q <= {lit.specular[bit_q], lit.diffuse[bit_q]};
      if (place.slot == chosen_q) begin
        known_q <= 1'b1;
        {specular_q, diffuse_q} <= {lit.specular[bit_q], lit.diffuse[bit_q]};
      end else if (place.shared && chosen_q == 2'd0) begin
        known_q <= before_known_q;
        {specular_q, diffuse_q} <= before_q;
      end
    end
    if (rst_i) {last_q, known_q, before_known_q} <= '0;
  end

  logic [W-1:0] diffuse, specular;
  assign diffuse  = W'(record.diffuse >> W * chosen_q);
  assign specular = W'(record.specular >> W * chosen_q);
  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    // A bit of an intensity, chosen once.
    if (started_q) one_of_its_bits : assume (bit_q < 5'd18);
    if (started_q) begin
      // A record comes a clock after its last node, and at no other time.
      // mutant: valid_o <= !rst_i && valid_i && place_i.last => valid_o <= !rst_i && valid_i
      in_time : assert (valid == last_q);
      // Each slot holds the light of the node that came last for it; slot 0 of a shared node that of the node before.
      // mutant: valid_i && place_i.shared && slot == 0 => valid_i && place_i.shared && slot == 1
      light : assert (!(valid && known_q) || (diffuse[bit_q] == diffuse_q && specular[bit_q] == specular_q));
      // The record's own fields are those that came with its last node.
      // mutant: head_q   <= place_i.head => head_q   <= ~place_i.head
      fields : assert (!valid || record.head == head_q);
    end
  end
endmodule
