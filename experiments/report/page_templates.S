/* The bytes of the pages, for report_page.cc and live_page.cc. */
  .section .rodata
  .global halfstep_report_template
  .global halfstep_report_template_end
halfstep_report_template:
  .incbin HALFSTEP_REPORT_TEMPLATE
halfstep_report_template_end:
  .byte 0
  .global halfstep_live_template
  .global halfstep_live_template_end
halfstep_live_template:
  .incbin HALFSTEP_LIVE_TEMPLATE
halfstep_live_template_end:
  .byte 0
  .global halfstep_sweep_template
  .global halfstep_sweep_template_end
halfstep_sweep_template:
  .incbin HALFSTEP_SWEEP_TEMPLATE
halfstep_sweep_template_end:
  .byte 0
  .section .note.GNU-stack,"",%progbits
