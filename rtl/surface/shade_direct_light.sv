// SPDX-License-Identifier: Apache-2.0
// shade_direct_light: diffuse and specular light of a pixel from its scalars a = N.L, h = N.H, P = N.N.
//
//   rho = 1/sqrt(P) - 1,  diffuse = a + a rho,  y = 1 - h,  x = 1 - cos = y - rho + y rho,  specular = lobe(x)
//
// shade_rho and shade_scalar_light, of which see the formats. pixel_o U0.16, saturated; short_o, long_o: see shade_rho.
// Error: docs and build/units.json. Latency LATENCY_DIRECT_LIGHT = 17 clocks, one pixel a clock.
// Example: a = 1/2, P = 1/4 (a normal of length 1/2 to the light) -> rho = 1, diffuse = 1.
module shade_direct_light (
  input  logic                                        clk_i,
  input  logic                                        write_i,
  input  logic        [shade_pkg::CHORD_INDEX_W-1:0]  address_i,
  input  shade_pkg::chord_t                           chord_i,
  input  logic        [shade_pkg::CHORD_SHIFT_W-1:0]  shift_i,
  input  logic signed [shade_pkg::EXCESS_W-1:0]       excess_i,
  input  shade_pkg::scalars_t                         scalars_i,
  output shade_pkg::pixel_t                           pixel_o,
  output logic                                        short_o,
  output logic                                        long_o
);
  logic signed [shade_pkg::RHO_F:0] rho;
  logic short, long;
  shade_rho u_rho (
    .clk_i, .p_i(scalars_i.p[shade_pkg::DIRECT_P_W-1-:shade_pkg::DIRECT_P_OUT_F+1]), .rho_o(rho), .short_o(short),
    .long_o(long)
  );
  logic signed [shade_pkg::INTENSITY_W-1:0] diffuse;
  shade_scalar_light u_light (
    .clk_i, .rst_i(1'b0), .write_i, .address_i, .chord_i, .shift_i, .excess_i,
    .a_i(scalars_i.a[shade_pkg::DIRECT_A_W-1-:shade_pkg::DIRECT_DIFFUSE_F+2]),
    .h_i(scalars_i.h[shade_pkg::DIRECT_H_W-1-:shade_pkg::DIRECT_X_F+2]), .rho_i(rho), .diffuse_o(diffuse),
    .specular_o(pixel_o.specular)
  );
  assign pixel_o.diffuse = diffuse[shade_pkg::PIXEL_W-1:0];
  shade_delay #(.WIDTH(2), .DEPTH(shade_pkg::LATENCY_DIRECT_LIGHT - shade_pkg::LATENCY_RHO)) u_flags (
    .clk_i, .d_i({short, long}), .q_o({short_o, long_o})
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, scalars_i, diffuse};
endmodule
