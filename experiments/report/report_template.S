/* The bytes of the page, for report_page.cc. */
  .section .rodata
  .global halfstep_report_template
  .global halfstep_report_template_end
halfstep_report_template:
  .incbin HALFSTEP_REPORT_TEMPLATE
halfstep_report_template_end:
  .byte 0
  .section .note.GNU-stack,"",%progbits
