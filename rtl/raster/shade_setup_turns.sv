// SPDX-License-Identifier: Apache-2.0
// shade_setup_turns: whose sum is made next, and which of its products.
//
//   face_i, face_wide_i   an area is wanted, and its factors are wide: it goes first
//   main_i, main_wide_i   the sum at step, likewise
//   taken_o               the area is begun with the next clock
//   active_o, face_o      a product, of an area
//   first_o, second_o, low_o, last_o   the first one of a sum; of its second two factors; of the lower parts; the last one
//
// Two products a sum, a clock each, four where factors are wide, first those of the upper parts. Latency 1 clock. face_i, main_i are looked at in the last
// clock of a sum and when there is none. Example: main_i, not wide -> first_o, then second_o and last_o, low_o with both.
module shade_setup_turns (
  input  logic clk_i,
  input  logic rst_i,
  input  logic face_i,
  input  logic face_wide_i,
  input  logic main_i,
  input  logic main_wide_i,
  output logic taken_o,
  output logic active_o,
  output logic face_o,
  output logic first_o,
  output logic second_o,
  output logic low_o,
  output logic last_o
);
  logic choose;
  assign last_o  = active_o && second_o && low_o;
  assign choose  = !active_o || last_o;
  assign taken_o = choose && face_i;
  always_ff @(posedge clk_i) begin
    if (choose) begin
      active_o <= face_i || main_i;
      face_o   <= face_i;
      low_o    <= !(face_i ? face_wide_i : main_wide_i);
      second_o <= 1'b0;
    end else begin
      second_o <= !second_o;
      low_o    <= low_o || second_o;
    end
    first_o <= choose;
    if (rst_i) active_o <= 1'b0;
  end
endmodule
