// SPDX-License-Identifier: Apache-2.0
// shade_collect: the light at the nodes of a record, one node after the other, into a record of shade_poly_span.
//
//   light_i    S1.16, light at a node; a record's nodes come in rising order
//   place_i    slot of the node; shared: first of a record whose slot 0 is the node that came last, not sent again;
//              last: the record is complete; head: of the record, taken with its last node
//   record_o   slots that the degree does not use hold what they held
//
// Latency LATENCY_COLLECT = 1 clock from a record's last node, one node a clock. Exact.
// Example: degree 1: (slot 0: 1/4, 1/8), (slot 1: 1/2, 1/8, last) -> nodes 1/4, 1/2 diffuse, 1/8, 1/8 specular.
module shade_collect (
  input  logic                  clk_i,
  input  logic                  rst_i,
  input  logic                  valid_i,
  input  shade_pkg::intensity_t light_i,
  input  shade_pkg::place_t     place_i,
  output logic                  valid_o,
  output shade_pkg::record_t    record_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int NODES = shade_pkg::NODE_COUNT;

  shade_pkg::intensity_t before_q;
  shade_pkg::head_t head_q;
  logic [NODES-1:0][W-1:0] diffuse_q, specular_q;
  for (genvar slot = 0; slot < NODES; slot++) begin : g_slot
    always_ff @(posedge clk_i) begin
      if (valid_i && place_i.slot == 2'(slot)) begin
        diffuse_q[slot]  <= light_i.diffuse;
        specular_q[slot] <= light_i.specular;
      end else if (valid_i && place_i.shared && slot == 0) begin
        diffuse_q[slot]  <= before_q.diffuse;
        specular_q[slot] <= before_q.specular;
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      before_q <= light_i;
      head_q   <= place_i.head;
    end
    valid_o <= !rst_i && valid_i && place_i.last;
  end
  assign record_o = shade_pkg::RECORD_BITS'({head_q, specular_q, diffuse_q});
endmodule
