// SPDX-License-Identifier: Apache-2.0
// shade_patch_light: the light of a node: of each light Lambert's and a highlight over N.H, summed.
//
//   a_i, h_i    N.L S1.17, N.H S1.24 of each light;   p_i N.N U1.25
//   excess_i    |H| - 1 of each light's quantized H;   table_*: see shade_chord: written while no light is inside
//   diffuse_o, specular_o   S1.16, limited. With several lights each one's diffuse light is at least 0, so that none is taken from others
//   short_o     N.N < 1/4: rho is limited
//
// One 1/sqrt for all lights, see shade_rho and shade_scalar_light: 2 + 3 LIGHTS multipliers. Latency LATENCY_DIRECT_LIGHT = 17
// clocks, one more for several lights; one node a clock. Example: N = L = H, |N| = 3/4 -> diffuse 1, x = 0.
// Source: Duff 1979, Bishop and Weimer 1986: the scalars.
module shade_patch_light #(
  parameter int LIGHTS = 1
) (
  input  logic                                              clk_i,
  input  logic                                              rst_i,
  input  logic [         LIGHTS*shade_pkg::EXCESS_W-1:0]    excess_i,
  input  logic [             shade_pkg::CHORD_SHIFT_W-1:0]  shift_i,
  input  logic                                              table_write_i,
  input  logic [             shade_pkg::CHORD_INDEX_W-1:0]  table_at_i,
  input  shade_pkg::chord_t                                 table_i,
  input  logic                                              valid_i,
  input  logic [LIGHTS*(shade_pkg::DIRECT_DIFFUSE_F+2)-1:0] a_i,
  input  logic [LIGHTS*(shade_pkg::DIRECT_X_F+2)-1:0]       h_i,
  input  logic [               shade_pkg::DIRECT_P_OUT_F:0] p_i,
  output logic                                              valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0]          diffuse_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0]          specular_o,
  output logic                                              short_o
);
  if (LIGHTS < 1 || LIGHTS > shade_pkg::PATCH_LIGHTS_MAX) begin : g_check
    $error("shade_patch_light: LIGHTS must be in 1 .. PATCH_LIGHTS_MAX");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int A_W = shade_pkg::DIRECT_DIFFUSE_F + 2;
  localparam int H_W = shade_pkg::DIRECT_X_F + 2;
  localparam int LATENCY = shade_pkg::LATENCY_DIRECT_LIGHT + (LIGHTS > 1 ? 1 : 0);
  logic signed [shade_pkg::RHO_F:0] rho;
  logic short;
  logic unused_rho;
  shade_rho u_rho (.clk_i, .p_i, .rho_o(rho), .short_o(short), .long_o(unused_rho));
  shade_delay #(.WIDTH(1), .DEPTH(LATENCY - shade_pkg::LATENCY_RHO)) u_short (.clk_i, .d_i(short), .q_o(short_o));
  shade_valid #(.DEPTH(LATENCY)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);

  logic [LIGHTS-1:0][W-1:0] diffuse;
  logic [LIGHTS-1:0][shade_pkg::PIXEL_W-1:0] specular;
  for (genvar i = 0; i < LIGHTS; i++) begin : g_light
    shade_scalar_light #(.SIGNED(1), .MEMORY(1)) u_light (
      .clk_i, .rst_i, .write_i(table_write_i), .address_i(table_at_i), .chord_i(table_i), .shift_i,
      .excess_i(excess_i[i*shade_pkg::EXCESS_W+:shade_pkg::EXCESS_W]), .a_i(a_i[i*A_W+:A_W]), .h_i(h_i[i*H_W+:H_W]),
      .rho_i(rho), .diffuse_o(diffuse[i]), .specular_o(specular[i])
    );
  end

  if (LIGHTS == 1) begin : g_one
    assign diffuse_o  = $signed(diffuse[0]);
    assign specular_o = $signed({2'b00, specular[0]});
  end else begin : g_sum
    localparam int SUM_W = W + 3;
    logic signed [SUM_W-1:0] diffuse_sum, specular_sum;
    logic signed [W-1:0] diffuse_fit, specular_fit;
    always_comb begin
      diffuse_sum  = '0;
      specular_sum = '0;
      for (int i = 0; i < LIGHTS; i++) begin
        diffuse_sum  = diffuse_sum + (diffuse[i][W-1] ? '0 : $signed(SUM_W'(diffuse[i])));
        specular_sum = specular_sum + $signed(SUM_W'(specular[i]));
      end
    end
    shade_limit #(.WIDTH(SUM_W), .OUT_W(W)) u_diffuse (.x_i(diffuse_sum), .y_o(diffuse_fit));
    shade_limit #(.WIDTH(SUM_W), .OUT_W(W)) u_specular (.x_i(specular_sum), .y_o(specular_fit));
    always_ff @(posedge clk_i) {diffuse_o, specular_o} <= {diffuse_fit, specular_fit};
  end
endmodule
