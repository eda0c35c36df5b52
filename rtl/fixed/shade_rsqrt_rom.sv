// SPDX-License-Identifier: Apache-2.0
// shade_rsqrt_rom: the table of shade_rsqrt: 1/sqrt(m) = c0 + c1 d + c2 d^2 on segment i_i / 32 of [1, 4).
//
// Generated from polyshade.golden.fixed.rsqrt_rom by `make generate`: change it there.
// row_o = {c0, c1, c2}: c0 U0.22, with the half ulp of the result's rounding; c1 S0.18, negative; c2 U0.12, 11 bits;
// rows below segment 32 are 0. Block RAM or LUTs, as the tool sees fit (6,528 bits). Latency 1 clock, one row a clock.
// Example: i = 32 -> c0 = 1/sqrt(1 + 1/64) + 2^-21.
module shade_rsqrt_rom (
  input  logic                                clk_i,
  input  logic [shade_pkg::RSQRT_INDEX_W-1:0] i_i,
  output logic [                            50:0] row_o
);
  always_ff @(posedge clk_i) begin
    case (i_i)
      7'd32: row_o <= 51'h7f02fb05dbdc6;
      7'd33: row_o <= 51'h7d1a0110f9d5a;
      7'd34: row_o <= 51'h7b46731b4b4f9;
      7'd35: row_o <= 51'h7986c924e44a1;
      7'd36: row_o <= 51'h77d9a72dd5c52;
      7'd37: row_o <= 51'h763dcd362fc09;
      7'd38: row_o <= 51'h74b2193dffbc8;
      7'd39: row_o <= 51'h7335874551b8b;
      7'd40: row_o <= 51'h71c7214c30b54;
      7'd41: row_o <= 51'h70660f52a6b22;
      7'd42: row_o <= 51'h6f118758bbaf4;
      7'd43: row_o <= 51'h6dc8cf5e782c9;
      7'd44: row_o <= 51'h6c8b3b63e22a2;
      7'd45: row_o <= 51'h6b582d6900a7d;
      7'd46: row_o <= 51'h6a2f176dd8a5b;
      7'd47: row_o <= 51'h690f6d727023c;
      7'd48: row_o <= 51'h67f8b576cb21f;
      7'd49: row_o <= 51'h66ea7b7aeea04;
      7'd50: row_o <= 51'h65e4537edd1eb;
      7'd51: row_o <= 51'h64e5d5829b9d3;
      7'd52: row_o <= 51'h63eea7862c1be;
      7'd53: row_o <= 51'h62fe6f89929a9;
      7'd54: row_o <= 51'h6214dd8cd1196;
      7'd55: row_o <= 51'h6131a18fea984;
      7'd56: row_o <= 51'h60547392e1173;
      7'd57: row_o <= 51'h5f7d1395b6963;
      7'd58: row_o <= 51'h5eab3d986d954;
      7'd59: row_o <= 51'h5ddeb99b07146;
      7'd60: row_o <= 51'h5d174b9d85939;
      7'd61: row_o <= 51'h5c54bf9fe992c;
      7'd62: row_o <= 51'h5b96e5a235920;
      7'd63: row_o <= 51'h5add89a46a915;
      7'd64: row_o <= 51'h5a2883a68a10a;
      7'd65: row_o <= 51'h5977a5a894900;
      7'd66: row_o <= 51'h58cac9aa8b0f7;
      7'd67: row_o <= 51'h5821c9ac6f8ee;
      7'd68: row_o <= 51'h577c7fae428e5;
      7'd69: row_o <= 51'h56dac9b0048dd;
      7'd70: row_o <= 51'h563c87b1b68d5;
      7'd71: row_o <= 51'h55a19bb3598ce;
      7'd72: row_o <= 51'h5509e5b4ee0c7;
      7'd73: row_o <= 51'h54754bb6750c0;
      7'd74: row_o <= 51'h53e3b1b7ee8ba;
      7'd75: row_o <= 51'h5354ffb95c0b4;
      7'd76: row_o <= 51'h52c91bbabd8ae;
      7'd77: row_o <= 51'h523fefbc138a8;
      7'd78: row_o <= 51'h51b963bd5f0a3;
      7'd79: row_o <= 51'h513565be9f89e;
      7'd80: row_o <= 51'h50b3ddbfd6899;
      7'd81: row_o <= 51'h5034b9c104094;
      7'd82: row_o <= 51'h4fb7e7c228090;
      7'd83: row_o <= 51'h4f3d55c34388c;
      7'd84: row_o <= 51'h4ec4f1c457088;
      7'd85: row_o <= 51'h4e4eadc562084;
      7'd86: row_o <= 51'h4dda75c665880;
      7'd87: row_o <= 51'h4d683fc76187c;
      7'd88: row_o <= 51'h4cf7f9c856879;
      7'd89: row_o <= 51'h4c8995c945075;
      7'd90: row_o <= 51'h4c1d07ca2c872;
      7'd91: row_o <= 51'h4bb243cb0d86f;
      7'd92: row_o <= 51'h4b493bcbe906c;
      7'd93: row_o <= 51'h4ae1e3ccbe069;
      7'd94: row_o <= 51'h4a7c31cd8e066;
      7'd95: row_o <= 51'h4a1817ce58064;
      7'd96: row_o <= 51'h49b58fcf1d861;
      7'd97: row_o <= 51'h49548bcfdd85f;
      7'd98: row_o <= 51'h48f501d09885c;
      7'd99: row_o <= 51'h4896ebd14f05a;
      7'd100: row_o <= 51'h483a3bd201058;
      7'd101: row_o <= 51'h47deebd2ae856;
      7'd102: row_o <= 51'h4784f3d358054;
      7'd103: row_o <= 51'h472c49d3fd052;
      7'd104: row_o <= 51'h46d4e7d49e850;
      7'd105: row_o <= 51'h467ec1d53c04e;
      7'd106: row_o <= 51'h4629d5d5d604c;
      7'd107: row_o <= 51'h45d617d66c04a;
      7'd108: row_o <= 51'h458383d6ff049;
      7'd109: row_o <= 51'h453211d78e847;
      7'd110: row_o <= 51'h44e1bbd81a845;
      7'd111: row_o <= 51'h44927bd8a4044;
      7'd112: row_o <= 51'h444449d92a042;
      7'd113: row_o <= 51'h43f721d9ad041;
      7'd114: row_o <= 51'h43aafbda2d03f;
      7'd115: row_o <= 51'h435fd5daaa83e;
      7'd116: row_o <= 51'h4315a5db2583d;
      7'd117: row_o <= 51'h42cc69db9d83b;
      7'd118: row_o <= 51'h42841bdc1383a;
      7'd119: row_o <= 51'h423cb5dc86839;
      7'd120: row_o <= 51'h41f633dcf7838;
      7'd121: row_o <= 51'h41b091dd66037;
      7'd122: row_o <= 51'h416bc9ddd2036;
      7'd123: row_o <= 51'h4127d7de3c034;
      7'd124: row_o <= 51'h40e4b9dea4033;
      7'd125: row_o <= 51'h40a267df0a032;
      7'd126: row_o <= 51'h4060dfdf6e031;
      7'd127: row_o <= 51'h40201ddfcf830;
      default: row_o <= '0;
    endcase
  end
endmodule
