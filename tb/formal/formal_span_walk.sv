// SPDX-License-Identifier: Apache-2.0
// formal_span_walk: shade_span_walk gives one token for every pixel of a record, at t = j 2^-log2, and waits for credits.
//
// The model holds the head and one bit of each node of the record at hand, and counts its pixels.
module formal_span_walk #(
  parameter int LOG2_MAX    = 3,
  parameter int CREDIT_LOG2 = 1
) (
  input logic               clk_i,
  input logic               rst_i,
  input logic               valid_i,
  input shade_pkg::record_t record_i,
  input logic               credit_i
);
  localparam int N_W = CREDIT_LOG2 + 2;
  localparam int J_W = LOG2_MAX + 1;
  logic ready, valid, load;
  shade_pkg::token_t token;
  shade_span_walk #(.LOG2_MAX(LOG2_MAX), .CREDIT_LOG2(CREDIT_LOG2)) u_dut (
    .clk_i, .rst_i, .valid_i, .ready_o(ready), .record_i, .credit_i, .valid_o(valid), .token_o(token)
  );
  assign load = valid_i && ready;

  // a token comes a clock behind its step: the record that it belongs to is the one before, if a new one was taken
  logic started_q = 1'b0;
  logic work_q, direct, late_work_q;
  logic [J_W-1:0] left_q, j_q, late_j_q, late_left_q;
  logic [3:0] node_q, late_node_q;  // a bit of each node
  logic [N_W-1:0] spent_q;
  shade_pkg::head_t head_q, late_head_q;
  logic issue;
  assign issue  = work_q && spent_q < N_W'(1 << CREDIT_LOG2);
  assign direct = late_head_q.degree == '0;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    spent_q   <= spent_q + N_W'(issue) - N_W'(credit_i);
    {late_work_q, late_head_q, late_j_q, late_left_q, late_node_q} <= {issue, head_q, j_q, left_q, node_q};
    if (load) begin
      {work_q, head_q, j_q} <= {1'b1, record_i.head, J_W'(0)};
      left_q <= J_W'(record_i.head.count);
      node_q <= {record_i.diffuse.n3[0], record_i.diffuse.n2[0], record_i.diffuse.n1[0], record_i.diffuse.n0[0]};
    end else if (issue) begin
      work_q <= left_q != J_W'(1);
      left_q <= left_q - J_W'(1);
      j_q    <= j_q + J_W'(1);
    end
    if (rst_i) {work_q, spent_q, late_work_q} <= '0;
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // A record has 1 .. 2^LOG2_MAX pixels, a direct one at most 4, and its arc is long enough.
      legal_record : assume (!valid_i || (record_i.head.count != '0 && record_i.head.count <= 13'(1 << LOG2_MAX)
        && (record_i.head.degree != '0 || record_i.head.count <= 13'd4) && record_i.head.log2 <= 4'(LOG2_MAX)));
      // The consumer gives back only credits that were spent.
      credits_are_spent : assume (!credit_i || spent_q != '0);
      // A token in every clock behind one in which a pixel was left and a credit there, and in no other.
      // mutant: valid_o          <= issue => valid_o          <= issue && !(first && last)
      in_time : assert (valid == late_work_q);
      // The next record is taken with the last step of the one before.
      // mutant: .count_i(record_i.head.count) => .count_i(record_i.head.count + COUNT_W'(1))
      no_bubble : assert (ready == (!work_q || (issue && left_q == J_W'(1))));
      // Tokens lie at t = j 2^-log2.
      // mutant: >> head_q.log2 => >> (head_q.log2 + 4'(first))
      position : assert (!valid || token.t == 17'(({late_j_q, 16'd0}) >> late_head_q.log2));
      // They are framed, and carry what the record has told.
      // mutant: last && !head_q.more => last
      framed : assert (!valid || (token.first == (late_j_q == '0 || direct)
        && token.last == (late_left_q == J_W'(1) && !late_head_q.more)));
      // mutant: token_o.tag      <= head_q.tag => token_o.tag      <= record_i.head.tag
      fields : assert (!valid || (token.tag == late_head_q.tag && token.degree == late_head_q.degree));
      // A direct pixel has its own node in first place; others have the nodes of the record.
      // mutant: diffuse_q >> shade_pkg::INTENSITY_W => diffuse_q
      nodes : assert (!valid || token.diffuse.n0[0] == late_node_q[direct ? late_j_q[1:0] : 2'd0]);
    end
  end
endmodule
