# Valgrind does not know the store form of vmovq between two registers, which the assembler takes where
# it is a byte shorter. The load form does the same. While the macro runs it has no name, since from
# binutils 2.44 on it would call itself.
.macro sonarsim_load_form
.macro vmovq operands:vararg
.purgem vmovq
{load} vmovq \operands
sonarsim_load_form
.endm
.endm
sonarsim_load_form
