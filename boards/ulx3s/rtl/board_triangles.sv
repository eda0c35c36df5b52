// SPDX-License-Identifier: Apache-2.0
// board_triangles: the triangles of the head as packets VERTEX, three corners each, from a table of their numbers.
//
// start_i begins with triangle 0; busy_o until the last corner is taken. corner_i: what read_o asked for two clocks ago.
// Latency 5 clocks a corner. Example: entry {2, 1, 0} -> vertices 0, 1, 2, tlast with the third.
module board_triangles #(
  parameter int COUNT = 1000
) (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  logic                                start_i,
  output logic                                busy_o,
  output logic [                         9:0] read_o,
  input  logic [                        96:0] corner_i,
  output logic                                m_axis_vertex_tvalid,
  input  logic                                m_axis_vertex_tready,
  output logic [shade_pkg::VERTEX_DATA_W-1:0] m_axis_vertex_tdata,
  output logic                                m_axis_vertex_tlast
);
  logic [29:0] triangles[0:1023];
  initial $readmemh("triangles.hex", triangles);
  logic [10:0] at_q;
  logic [1:0] corner_q;
  logic [29:0] triangle_q;
  logic [4:0] look_q;
  logic taken, ends;
  shade_pkg::vertex_t vertex;
  assign taken = m_axis_vertex_tvalid && m_axis_vertex_tready;
  assign ends  = corner_q == 2'd2;
  always_ff @(posedge clk_i) begin
    triangle_q <= triangles[at_q[9:0]];
    case (corner_q)
      2'd0: read_o <= triangle_q[9:0];
      2'd1: read_o <= triangle_q[19:10];
      default: read_o <= triangle_q[29:20];
    endcase
    look_q <= {look_q[3:0], start_i || (taken && busy_o)};
    if (look_q[4] && busy_o) m_axis_vertex_tvalid <= 1'b1;
    if (taken) begin
      m_axis_vertex_tvalid <= 1'b0;
      corner_q             <= ends ? 2'd0 : corner_q + 2'd1;
      if (ends) at_q <= at_q + 11'd1;
      if (ends && at_q == 11'(COUNT - 1)) busy_o <= 1'b0;
    end
    if (start_i) begin
      at_q     <= '0;
      corner_q <= '0;
      busy_o   <= 1'b1;
    end
    if (rst_i) {busy_o, m_axis_vertex_tvalid, look_q} <= '0;
  end
  logic [16:0] column;
  logic [15:0] line, depth;
  logic signed [15:0] nx, ny, nz;
  assign {nz, ny, nx, depth, line, column} = corner_i;
  always_comb begin
    vertex          = '0;
    vertex.x        = 32'(column);
    vertex.y        = 32'(line);
    vertex.depth    = 32'({depth, 8'd0});
    vertex.normal.x = 32'($signed({nx, 1'b0}));
    vertex.normal.y = 32'($signed({ny, 1'b0}));
    vertex.normal.z = 32'($signed({nz, 1'b0}));
  end
  assign m_axis_vertex_tdata = vertex;
  assign m_axis_vertex_tlast = ends;
endmodule
