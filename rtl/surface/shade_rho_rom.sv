// SPDX-License-Identifier: Apache-2.0
// shade_rho_rom: the table of shade_rho: 1/sqrt(P) - 1 = c0 + c1 d + c2 d^2 on segment i_i / 128 of P.
//
// Generated from polyshade.golden.direct.rho_rom by `make generate`: change it there.
// row_o = {c0, c1, c2}: c0 S1.25; c1 S2.15, negative; c2 U4.7. Row 0: [1, 129/128); rows 1 to 31 are constant.
// Block RAM or LUTs, as the tool sees fit (7,168 bits). Latency 1 clock, one row a clock.
// Example: i = 64 -> c0 = 1/sqrt(129/256) - 1.
module shade_rho_rom (
  input  logic                              clk_i,
  input  logic [shade_pkg::RHO_INDEX_W-1:0] i_i,
  output logic [                          55:0] row_o
);
  always_ff @(posedge clk_i) begin
    case (i_i)
      7'd0: row_o <= 56'hffe017fe02f830;
      7'd1: row_o <= 56'h3fffe000000000;
      7'd2: row_o <= 56'h3fffe000000000;
      7'd3: row_o <= 56'h3fffe000000000;
      7'd4: row_o <= 56'h3fffe000000000;
      7'd5: row_o <= 56'h3fffe000000000;
      7'd6: row_o <= 56'h3fffe000000000;
      7'd7: row_o <= 56'h3fffe000000000;
      7'd8: row_o <= 56'h3fffe000000000;
      7'd9: row_o <= 56'h3fffe000000000;
      7'd10: row_o <= 56'h3fffe000000000;
      7'd11: row_o <= 56'h3fffe000000000;
      7'd12: row_o <= 56'h3fffe000000000;
      7'd13: row_o <= 56'h3fffe000000000;
      7'd14: row_o <= 56'h3fffe000000000;
      7'd15: row_o <= 56'h3fffe000000000;
      7'd16: row_o <= 56'h3fffe000000000;
      7'd17: row_o <= 56'h3fffe000000000;
      7'd18: row_o <= 56'h3fffe000000000;
      7'd19: row_o <= 56'h3fffe000000000;
      7'd20: row_o <= 56'h3fffe000000000;
      7'd21: row_o <= 56'h3fffe000000000;
      7'd22: row_o <= 56'h3fffe000000000;
      7'd23: row_o <= 56'h3fffe000000000;
      7'd24: row_o <= 56'h3fffe000000000;
      7'd25: row_o <= 56'h3fffe000000000;
      7'd26: row_o <= 56'h3fffe000000000;
      7'd27: row_o <= 56'h3fffe000000000;
      7'd28: row_o <= 56'h3fffe000000000;
      7'd29: row_o <= 56'h3fffe000000000;
      7'd30: row_o <= 56'h3fffe000000000;
      7'd31: row_o <= 56'h3fffe000000000;
      7'd32: row_o <= 56'h3f02d6305dbdc6;
      7'd33: row_o <= 56'h3d19fcb10f9d5a;
      7'd34: row_o <= 56'h3b466df1b4b4f9;
      7'd35: row_o <= 56'h3986c4f24e44a1;
      7'd36: row_o <= 56'h37d9a272dd5c52;
      7'd37: row_o <= 56'h363dc83362fc09;
      7'd38: row_o <= 56'h34b214f3dffbc8;
      7'd39: row_o <= 56'h33358134551b8b;
      7'd40: row_o <= 56'h31c71c94c30b54;
      7'd41: row_o <= 56'h30660ad52a6b22;
      7'd42: row_o <= 56'h2f1182558bbaf4;
      7'd43: row_o <= 56'h2dc8c975e782c9;
      7'd44: row_o <= 56'h2c8b35763e22a2;
      7'd45: row_o <= 56'h2b582896900a7d;
      7'd46: row_o <= 56'h2a2f1116dd8a5b;
      7'd47: row_o <= 56'h290f683727023c;
      7'd48: row_o <= 56'h27f8b0d76cb21f;
      7'd49: row_o <= 56'h26ea76b7aeea04;
      7'd50: row_o <= 56'h25e44d97edd1eb;
      7'd51: row_o <= 56'h24e5d0f829b9d3;
      7'd52: row_o <= 56'h23eea29862c1be;
      7'd53: row_o <= 56'h22fe6ad89929a9;
      7'd54: row_o <= 56'h2214d778cd1196;
      7'd55: row_o <= 56'h21319b98fea984;
      7'd56: row_o <= 56'h20546ef92e1173;
      7'd57: row_o <= 56'h1f7d0df95b6963;
      7'd58: row_o <= 56'h1eab38b986d954;
      7'd59: row_o <= 56'h1ddeb399b07146;
      7'd60: row_o <= 56'h1d1745f9d85939;
      7'd61: row_o <= 56'h1c54ba99fe992c;
      7'd62: row_o <= 56'h1b96df5a235920;
      7'd63: row_o <= 56'h1add84da46a915;
      7'd64: row_o <= 56'h1a287e1a68a10a;
      7'd65: row_o <= 56'h1977a0ba894900;
      7'd66: row_o <= 56'h18cac49aa8b0f7;
      7'd67: row_o <= 56'h1821c37ac6f8ee;
      7'd68: row_o <= 56'h177c793ae428e5;
      7'd69: row_o <= 56'h16dac39b0048dd;
      7'd70: row_o <= 56'h163c81fb1b68d5;
      7'd71: row_o <= 56'h15a1953b3598ce;
      7'd72: row_o <= 56'h1509dffb4ee0c7;
      7'd73: row_o <= 56'h147545fb6750c0;
      7'd74: row_o <= 56'h13e3ac7b7ee8ba;
      7'd75: row_o <= 56'h1354f9fb95c0b4;
      7'd76: row_o <= 56'h12c9163babd8ae;
      7'd77: row_o <= 56'h123fe9bbc138a8;
      7'd78: row_o <= 56'h11b95e7bd5f0a3;
      7'd79: row_o <= 56'h11355f3be9f89e;
      7'd80: row_o <= 56'h10b3d77bfd6899;
      7'd81: row_o <= 56'h1034b3fc104094;
      7'd82: row_o <= 56'hfb7e21c228090;
      7'd83: row_o <= 56'hf3d4fdc34388c;
      7'd84: row_o <= 56'hec4ec5c457088;
      7'd85: row_o <= 56'he4ea73c562084;
      7'd86: row_o <= 56'hdda709c665880;
      7'd87: row_o <= 56'hd68395c76187c;
      7'd88: row_o <= 56'hcf7f33c856879;
      7'd89: row_o <= 56'hc89901c945075;
      7'd90: row_o <= 56'hc1d02bca2c872;
      7'd91: row_o <= 56'hbb23e1cb0d86f;
      7'd92: row_o <= 56'hb4935dcbe906c;
      7'd93: row_o <= 56'hae1de3ccbe069;
      7'd94: row_o <= 56'ha7c2bbcd8e066;
      7'd95: row_o <= 56'ha18131ce58064;
      7'd96: row_o <= 56'h9b589dcf1d861;
      7'd97: row_o <= 56'h95485bcfdd85f;
      7'd98: row_o <= 56'h8f4fcbd09885c;
      7'd99: row_o <= 56'h896e55d14f05a;
      7'd100: row_o <= 56'h83a365d201058;
      7'd101: row_o <= 56'h7dee6fd2ae856;
      7'd102: row_o <= 56'h784ee7d358054;
      7'd103: row_o <= 56'h72c449d3fd052;
      7'd104: row_o <= 56'h6d4e15d49e850;
      7'd105: row_o <= 56'h67ebcdd53c04e;
      7'd106: row_o <= 56'h629cfbd5d604c;
      7'd107: row_o <= 56'h5d6129d66c04a;
      7'd108: row_o <= 56'h5837e9d6ff049;
      7'd109: row_o <= 56'h5320cdd78e847;
      7'd110: row_o <= 56'h4e1b6dd81a845;
      7'd111: row_o <= 56'h49275fd8a4044;
      7'd112: row_o <= 56'h444445d92a042;
      7'd113: row_o <= 56'h3f71bdd9ad041;
      7'd114: row_o <= 56'h3aaf69da2d03f;
      7'd115: row_o <= 56'h35fcf3daaa83e;
      7'd116: row_o <= 56'h3159ffdb2583d;
      7'd117: row_o <= 56'h2cc63bdb9d83b;
      7'd118: row_o <= 56'h284153dc1383a;
      7'd119: row_o <= 56'h23caf9dc86839;
      7'd120: row_o <= 56'h1f62e1dcf7838;
      7'd121: row_o <= 56'h1b08bbdd66037;
      7'd122: row_o <= 56'h16bc41ddd2036;
      7'd123: row_o <= 56'h127d2dde3c034;
      7'd124: row_o <= 56'he4b39dea4033;
      7'd125: row_o <= 56'ha261fdf0a032;
      7'd126: row_o <= 56'h60da3df6e031;
      7'd127: row_o <= 56'h20183dfcf830;
      default: row_o <= '0;
    endcase
  end
endmodule
