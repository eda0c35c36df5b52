"""cocotb benches of rtl/plan."""
