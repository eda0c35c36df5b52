"""cocotb benches of rtl/poly."""
