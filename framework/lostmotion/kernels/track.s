	.file	"<string>"
	.section	.rodata,"a",@progbits
	.p2align	6, 0x0
.LCPI0_0:
	.quad	0
	.quad	1
	.quad	2
	.quad	3
	.quad	4
	.quad	5
	.quad	6
	.quad	7
	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI0_1:
	.quad	8
.LCPI0_2:
	.quad	16
.LCPI0_3:
	.quad	24
.LCPI0_4:
	.quad	32
.LCPI0_5:
	.quad	0x3ff0000000000000
.LCPI0_6:
	.quad	0x3fc45f306dc9c883
.LCPI0_7:
	.quad	0x3fe0000000000000
	.section	.ltext,"axl",@progbits
	.globl	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$1048, %rsp
	.cfi_def_cfa_offset 1104
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	%r9, 200(%rsp)
	movq	%r8, 192(%rsp)
	movq	1536(%rsp), %r8
	movq	1480(%rsp), %r9
	movq	%rcx, 656(%rsp)
	movabsq	$9223372036854775800, %rcx
	vmovq	%xmm0, 320(%rsp)
	movq	%rdx, 328(%rsp)
	movq	$0, 712(%rsp)
	movq	$0, 704(%rsp)
	movq	$0, 216(%rsp)
	movq	$0, 696(%rsp)
	movq	$0, 688(%rsp)
	movq	$0, 680(%rsp)
	movq	$0, 208(%rsp)
	movq	$0, 344(%rsp)
	movq	$0, 672(%rsp)
	movq	$0, 664(%rsp)
	movq	%rsi, 64(%rsp)
	movq	%rdi, 224(%rsp)
	movq	%rcx, 88(%rsp)
	testq	%r9, %r9
	jle	.LBB0_3
	cmpq	$8, %r9
	jae	.LBB0_4
	xorl	%edi, %edi
	xorl	%eax, %eax
	jmp	.LBB0_13
.LBB0_3:
	xorl	%edi, %edi
	jmp	.LBB0_15
.LBB0_4:
	movq	1552(%rsp), %rax
	vpbroadcastq	%rax, %zmm0
	cmpq	$32, %r9
	jae	.LBB0_6
	xorl	%eax, %eax
	xorl	%edi, %edi
	jmp	.LBB0_10
.LBB0_6:
	movabsq	$.LCPI0_0, %rdx
	movabsq	$.LCPI0_1, %rsi
	leaq	-24(%rcx), %rax
	vpternlogd	$255, %zmm6, %zmm6, %zmm6
	vpxor	%xmm1, %xmm1, %xmm1
	vpxor	%xmm8, %xmm8, %xmm8
	vpxor	%xmm9, %xmm9, %xmm9
	vpxor	%xmm10, %xmm10, %xmm10
	vmovdqa64	(%rdx), %zmm2
	movabsq	$.LCPI0_2, %rdx
	vpbroadcastq	(%rsi), %zmm3
	movabsq	$.LCPI0_3, %rsi
	andq	%r9, %rax
	vpbroadcastq	(%rdx), %zmm4
	movabsq	$.LCPI0_4, %rdx
	vpbroadcastq	(%rsi), %zmm5
	movq	%rax, %rcx
	vpbroadcastq	(%rdx), %zmm7
	.p2align	4
.LBB0_7:
	vpaddq	%zmm3, %zmm2, %zmm11
	vpmullq	%zmm0, %zmm2, %zmm14
	vpaddq	%zmm4, %zmm2, %zmm12
	vpaddq	%zmm5, %zmm2, %zmm13
	kxnorb	%k0, %k0, %k1
	vpxor	%xmm15, %xmm15, %xmm15
	vpaddq	%zmm7, %zmm2, %zmm2
	addq	$-32, %rcx
	vpmullq	%zmm0, %zmm11, %zmm11
	vpmullq	%zmm0, %zmm12, %zmm12
	vpmullq	%zmm0, %zmm13, %zmm13
	vpgatherqq	16(%r8,%zmm14,8), %zmm15 {%k1}
	kxnorb	%k0, %k0, %k1
	vpxor	%xmm14, %xmm14, %xmm14
	vpgatherqq	16(%r8,%zmm11,8), %zmm14 {%k1}
	kxnorb	%k0, %k0, %k1
	vpxor	%xmm11, %xmm11, %xmm11
	vpgatherqq	16(%r8,%zmm12,8), %zmm11 {%k1}
	kxnorb	%k0, %k0, %k1
	vpxor	%xmm12, %xmm12, %xmm12
	vpgatherqq	16(%r8,%zmm13,8), %zmm12 {%k1}
	vpsubq	%zmm6, %zmm15, %zmm13
	vpmaxsq	%zmm1, %zmm13, %zmm1
	vpsubq	%zmm6, %zmm14, %zmm13
	vpsubq	%zmm6, %zmm11, %zmm11
	vpmaxsq	%zmm8, %zmm13, %zmm8
	vpsubq	%zmm6, %zmm12, %zmm12
	vpmaxsq	%zmm9, %zmm11, %zmm9
	vpmaxsq	%zmm10, %zmm12, %zmm10
	jne	.LBB0_7
	vpmaxsq	%zmm8, %zmm1, %zmm1
	vpmaxsq	%zmm10, %zmm9, %zmm2
	vpmaxsq	%zmm2, %zmm1, %zmm1
	vextracti64x4	$1, %zmm1, %ymm2
	vpmaxsq	%zmm2, %zmm1, %zmm1
	vextracti128	$1, %ymm1, %xmm2
	vpmaxsq	%xmm2, %xmm1, %xmm1
	vpshufd	$238, %xmm1, %xmm2
	vpmaxsq	%xmm2, %xmm1, %xmm1
	vmovq	%xmm1, %rdi
	cmpq	%rax, %r9
	je	.LBB0_15
	testb	$24, %r9b
	je	.LBB0_13
.LBB0_10:
	vpbroadcastq	%rdi, %zmm1
	movabsq	$.LCPI0_1, %rsi
	movabsq	$.LCPI0_0, %rdi
	movq	%rax, %rcx
	vpbroadcastq	%rcx, %zmm2
	movabsq	$9223372036854775800, %rdx
	movq	%r9, %rax
	vpternlogd	$255, %zmm3, %zmm3, %zmm3
	vporq	(%rdi), %zmm2, %zmm2
	vpbroadcastq	(%rsi), %zmm4
	andq	%rdx, %rax
	.p2align	4
.LBB0_11:
	vpmullq	%zmm0, %zmm2, %zmm5
	kxnorb	%k0, %k0, %k1
	vpxor	%xmm6, %xmm6, %xmm6
	vpaddq	%zmm4, %zmm2, %zmm2
	addq	$8, %rcx
	vpgatherqq	16(%r8,%zmm5,8), %zmm6 {%k1}
	vpsubq	%zmm3, %zmm6, %zmm5
	vpmaxsq	%zmm1, %zmm5, %zmm1
	cmpq	%rcx, %rax
	jne	.LBB0_11
	vextracti64x4	$1, %zmm1, %ymm0
	vpmaxsq	%zmm0, %zmm1, %zmm0
	vextracti128	$1, %ymm0, %xmm1
	vpmaxsq	%xmm1, %xmm0, %xmm0
	vpshufd	$238, %xmm0, %xmm1
	vpmaxsq	%xmm1, %xmm0, %xmm0
	vmovq	%xmm0, %rdi
	cmpq	%rax, %r9
	je	.LBB0_15
.LBB0_13:
	movq	1552(%rsp), %rdx
	movq	%rax, %rcx
	subq	%r9, %rax
	imulq	%rdx, %rcx
	leaq	(,%rdx,8), %rdx
	leaq	16(%r8,%rcx,8), %rcx
	.p2align	4
.LBB0_14:
	movq	%rdi, %rsi
	movq	(%rcx), %rdi
	incq	%rdi
	cmpq	%rsi, %rdi
	cmovleq	%rsi, %rdi
	addq	%rdx, %rcx
	incq	%rax
	jne	.LBB0_14
.LBB0_15:
	movq	1192(%rsp), %rax
	vcvtsi2sdq	1792(%rsp), %xmm31, %xmm0
	movq	2584(%rsp), %rsi
	movq	1832(%rsp), %r13
	movq	%rdi, 160(%rsp)
	movq	40(%rax), %rcx
	movq	48(%rax), %rax
	testq	%rsi, %rsi
	movq	%rcx, 48(%rsp)
	leaq	7(%rsi), %rcx
	movq	%rax, 336(%rsp)
	setle	%al
	movq	%rcx, 112(%rsp)
	shrq	$3, %rcx
	sete	%dl
	movq	%rcx, 80(%rsp)
	orb	%al, %dl
	movb	%dl, 4(%rsp)
	je	.LBB0_112
.LBB0_16:
	movq	1472(%rsp), %rcx
	testq	%rcx, %rcx
	jle	.LBB0_148
	cmpq	$2, 2216(%rsp)
	movq	2456(%rsp), %rax
	movq	1848(%rsp), %r14
	movq	2088(%rsp), %r11
	movq	2000(%rsp), %rbx
	movq	2584(%rsp), %r9
	movq	80(%rsp), %r12
	movq	$0, 16(%rsp)
	movq	$0, 24(%rsp)
	setge	7(%rsp)
	cmpq	$0, 336(%rsp)
	leaq	-1(%r9), %r8
	setle	%r10b
	imulq	2464(%rsp), %rax
	orb	4(%rsp), %r10b
	imulq	1992(%rsp), %rbx
	imulq	2080(%rsp), %r11
	decq	%rcx
	andl	$7, %r12d
	imulq	$424, %r14, %rbp
	movq	%rcx, 640(%rsp)
	movq	%r12, 32(%rsp)
	movb	%r10b, 3(%rsp)
	imulq	$352, %r14, %r10
	movq	%rax, 600(%rsp)
	movabsq	$.LCPI0_7, %rax
	leaq	(,%r11,8), %r15
	leaq	(,%rbx,8), %rdx
	movq	%rbx, %rsi
	movq	%r11, %rdi
	imulq	%r8, %rsi
	imulq	%r8, %rdi
	vmovsd	(%rax), %xmm2
	movabsq	$.LCPI0_0, %rax
	movq	%r10, 256(%rsp)
	imulq	$360, %r14, %r10
	vmovaps	(%rax), %zmm1
	movabsq	$.LCPI0_6, %rax
	movq	%r15, %rcx
	negq	%rcx
	movq	%rdx, 176(%rsp)
	movq	%r15, 168(%rsp)
	vbroadcastsd	(%rax), %zmm3
	movabsq	$.LCPI0_1, %rax
	movq	%r10, 248(%rsp)
	imulq	$368, %r14, %r10
	movq	%r10, 240(%rsp)
	imulq	$376, %r14, %r10
	vmovsd	%xmm2, 8(%rsp)
	vmovups	%zmm1, 720(%rsp)
	vbroadcastsd	(%rax), %zmm1
	movq	2296(%rsp), %rax
	movq	%r10, 232(%rsp)
	movq	2064(%rsp), %r10
	imulq	2304(%rsp), %rax
	vmovupd	%zmm3, 976(%rsp)
	movq	%r10, 184(%rsp)
	movq	%rax, 560(%rsp)
	movabsq	$.LCPI0_5, %rax
	vmovups	%zmm1, 912(%rsp)
	vmovsd	(%rax), %xmm1
	movq	2544(%rsp), %rax
	imulq	2552(%rsp), %rax
	movq	%rax, 552(%rsp)
	movq	%r14, %rax
	shlq	$4, %rax
	vmovaps	%xmm1, 352(%rsp)
	vmovsd	320(%rsp), %xmm1
	movq	%rax, 296(%rsp)
	movq	%r14, %rax
	shlq	$5, %rax
	movq	%rax, 288(%rsp)
	movq	%rdx, %rax
	negq	%rax
	testq	%rdx, %rdx
	cmovnsq	%rdx, %rax
	mulq	%r8
	seto	6(%rsp)
	movq	%rax, 520(%rsp)
	negq	%rax
	testq	%r15, %r15
	cmovnsq	%r15, %rcx
	movq	%rax, 512(%rsp)
	vdivsd	%xmm0, %xmm1, %xmm0
	movq	1696(%rsp), %r15
	vxorpd	%xmm1, %xmm1, %xmm1
	movq	%rcx, %rax
	leaq	(,%r14,8), %rcx
	movq	1976(%rsp), %r14
	mulq	%r8
	seto	5(%rsp)
	andq	%r9, 88(%rsp)
	shll	$6, %r12d
	leaq	(%rcx,%rcx,2), %rdx
	leaq	(%rcx,%rcx,4), %rcx
	movq	%rax, 504(%rsp)
	negq	%rax
	movq	%rcx, 272(%rsp)
	movq	%rax, 496(%rsp)
	movq	48(%rsp), %rax
	movq	%rdx, 280(%rsp)
	leaq	(%r14,%rsi,8), %rcx
	movq	%r14, 72(%rsp)
	movq	%rcx, 624(%rsp)
	leaq	(%r10,%rdi,8), %rcx
	movl	%r9d, %edi
	andl	$7, %edi
	negq	%r9
	movq	%rdi, 264(%rsp)
	negq	%rdi
	movq	%r9, 472(%rsp)
	movq	%rcx, 616(%rsp)
	movq	1680(%rsp), %rcx
	shlq	$9, %rax
	movq	%rdi, 528(%rsp)
	leaq	56(%r13,%rbp), %rdi
	addq	%r13, %rbp
	movq	%rbp, 608(%rsp)
	movq	1688(%rsp), %rbp
	movq	%rdi, 568(%rsp)
	movq	80(%rsp), %rdi
	vmovsd	%xmm0, 632(%rsp)
	vpbroadcastq	%rbx, %zmm0
	shlq	$6, %rbx
	vmovdqu64	%zmm0, 848(%rsp)
	vpbroadcastq	%r11, %zmm0
	shlq	$6, %r11
	movq	%rbx, 488(%rsp)
	leaq	704(%rax,%rcx), %r8
	leaq	256(%rax,%rcx), %rax
	movq	112(%rsp), %rcx
	vmovdqu64	%zmm0, 784(%rsp)
	movq	%r11, 480(%rsp)
	movq	%rax, 584(%rsp)
	movq	1792(%rsp), %rax
	movq	%r8, 592(%rsp)
	shrq	$6, %rcx
	shlq	$3, %rcx
	leaq	(%rax,%rax,2), %rax
	negq	%rcx
	movq	%rcx, 112(%rsp)
	movq	1536(%rsp), %rcx
	movq	%rax, 648(%rsp)
	movq	2000(%rsp), %rax
	leaq	(,%rax,8), %rax
	movq	%rax, 312(%rsp)
	movq	2088(%rsp), %rax
	leaq	(,%rax,8), %rax
	movq	%rax, 304(%rsp)
	leaq	-1(%rdi), %rax
	movq	%rax, 40(%rsp)
	leaq	16(%rcx), %rax
	movq	%rax, 576(%rsp)
	movq	1552(%rsp), %rax
	leaq	(,%rax,8), %rax
	movq	%rax, 120(%rsp)
	movzbl	3(%rsp), %eax
	jmp	.LBB0_19
	.p2align	4
.LBB0_18:
	movq	184(%rsp), %rax
	movq	1696(%rsp), %r15
	movq	%rbx, 16(%rsp)
	addq	304(%rsp), %rax
	movq	%rax, 184(%rsp)
	movq	72(%rsp), %rax
	addq	312(%rsp), %rax
	movq	%rax, 72(%rsp)
	movzbl	3(%rsp), %eax
.LBB0_19:
	testb	%al, %al
	je	.LBB0_83
.LBB0_20:
	cmpq	$1, 2216(%rsp)
	movq	16(%rsp), %r9
	jle	.LBB0_22
	vmovsd	(%r13), %xmm0
	movq	%r9, %rax
	imulq	2384(%rsp), %rax
	movq	2368(%rsp), %r8
	movq	296(%rsp), %rsi
	movq	600(%rsp), %rcx
	movq	2440(%rsp), %rdi
	imulq	%r9, %rcx
	vmovsd	%xmm0, (%r8,%rax,8)
	leaq	(%rdi,%rcx,8), %rdx
	vmovsd	(%r13,%rsi), %xmm0
	movq	280(%rsp), %rsi
	vmovsd	%xmm0, (%rdi,%rcx,8)
	vmovsd	(%r13,%rsi), %xmm0
	vmovsd	%xmm0, 8(%rdi,%rcx,8)
	movq	1848(%rsp), %rcx
	vmovsd	(%r13,%rcx,8), %xmm0
	movq	272(%rsp), %rcx
	vmovsd	%xmm0, 8(%r8,%rax,8)
	movq	288(%rsp), %rax
	vmovsd	(%r13,%rax), %xmm0
	movq	2464(%rsp), %rax
	vmovsd	%xmm0, (%rdx,%rax,8)
	vmovq	(%r13,%rcx), %xmm0
	vmovq	%xmm0, 8(%rdx,%rax,8)
.LBB0_22:
	vcvtsi2sd	%r9, %xmm15, %xmm0
	vmulsd	320(%rsp), %xmm0, %xmm0
	movq	648(%rsp), %rax
	movq	1480(%rsp), %rcx
	imulq	%r9, %rax
	movq	%rax, 104(%rsp)
	vmovsd	%xmm0, 96(%rsp)
	testq	%rcx, %rcx
	jle	.LBB0_63
	movq	1464(%rsp), %rdx
	movq	%r9, %rax
	imulq	%rcx, %rax
	movq	1976(%rsp), %rcx
	movq	312(%rsp), %rsi
	movq	304(%rsp), %rdi
	movq	72(%rsp), %rbp
	movq	184(%rsp), %rbx
	xorl	%r15d, %r15d
	leaq	(%rdx,%rax,8), %rax
	movq	2064(%rsp), %rdx
	imulq	%r9, %rsi
	imulq	%r9, %rdi
	movq	%rax, 56(%rsp)
	movq	%r9, %rax
	imulq	2000(%rsp), %rax
	leaq	(%rcx,%rsi), %r8
	addq	624(%rsp), %rsi
	movq	%r8, 136(%rsp)
	movq	%rsi, 152(%rsp)
	leaq	(%rcx,%rax,8), %rax
	leaq	(%rdx,%rdi), %rcx
	addq	616(%rsp), %rdi
	movq	%rcx, 128(%rsp)
	movq	%rax, 544(%rsp)
	movq	%r9, %rax
	imulq	2088(%rsp), %rax
	movq	%rdi, 144(%rsp)
	leaq	(%rdx,%rax,8), %rax
	movq	%rax, 536(%rsp)
	jmp	.LBB0_26
	.p2align	4
.LBB0_24:
	vmovsd	8(%rsp), %xmm2
.LBB0_25:
	incq	%r15
	addq	$8, %rbx
	addq	$8, %rbp
	cmpq	%r15, 1480(%rsp)
	je	.LBB0_63
.LBB0_26:
	movq	136(%rsp), %rax
	movq	128(%rsp), %rdx
	movq	56(%rsp), %r8
	leaq	(%rax,%r15,8), %r9
	movq	152(%rsp), %rax
	leaq	(%rdx,%r15,8), %rdi
	movq	144(%rsp), %rdx
	vmovsd	(%r8,%r15,8), %xmm0
	leaq	(%rax,%r15,8), %rax
	leaq	(%rdx,%r15,8), %rsi
	cmpq	%rax, %r9
	movq	%rax, %rcx
	movq	%rsi, %rdx
	cmovbq	%r9, %rcx
	cmovaq	%r9, %rax
	cmpq	%rsi, %rdi
	cmovbq	%rdi, %rdx
	cmovaq	%rdi, %rsi
	vucomisd	%xmm0, %xmm0
	jp	.LBB0_42
	movq	%r15, %r14
	imulq	1552(%rsp), %r14
	movq	1536(%rsp), %rax
	movq	8(%rax,%r14,8), %rcx
	testq	%rcx, %rcx
	js	.LBB0_31
	cmpb	$0, 4(%rsp)
	jne	.LBB0_40
	vmovapd	352(%rsp), %xmm1
	movq	%rcx, %rax
	shlq	$8, %rax
	testq	%rcx, %rcx
	sete	%dl
	cmpq	$1, %rcx
	kmovd	%edx, %k1
	sete	%cl
	cmpq	$7, 40(%rsp)
	vmovsd	%xmm1, %xmm1, %xmm0 {%k1} {z}
	kmovd	%ecx, %k1
	vbroadcastsd	%xmm0, %zmm0
	vmovsd	%xmm1, %xmm1, %xmm1 {%k1} {z}
	vbroadcastsd	%xmm1, %zmm1
	jae	.LBB0_35
	xorl	%esi, %esi
	jmp	.LBB0_38
	.p2align	4
.LBB0_31:
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	vmovsd	104(%rsp), %xmm0
	movq	200(%rsp), %rdx
	movq	208(%rsp), %rcx
	movq	1112(%rsp), %r8
	movq	1120(%rsp), %r9
	leaq	720(%rsp), %rdi
	leaq	712(%rsp), %rsi
	pushq	2592(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	120(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1448(%rsp)
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx, %rax
	vzeroupper
	callq	*%rax
	addq	$336, %rsp
	.cfi_adjust_cfa_offset -336
	cmpl	$-2, %eax
	je	.LBB0_33
	testl	%eax, %eax
	jne	.LBB0_111
.LBB0_33:
	movq	1536(%rsp), %rax
	movq	(%rax,%r14,8), %rax
	movq	$0, 216(%rsp)
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	movq	336(%rsp), %rdx
	movq	664(%rsp), %rcx
	movq	200(%rsp), %r8
	movq	208(%rsp), %r9
	leaq	224(%rsp), %rdi
	leaq	704(%rsp), %rsi
	pushq	2592(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	1888(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1888(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1888(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1888(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r13
	.cfi_adjust_cfa_offset 8
	pushq	1888(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1888(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1888(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1888(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1304(%rsp)
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10linearisedB3v21B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx, %rax
	callq	*%rax
	addq	$208, %rsp
	.cfi_adjust_cfa_offset -208
	testl	%eax, %eax
	jne	.LBB0_111
	movq	24(%rsp), %rax
	orq	216(%rsp), %rax
	movq	%rax, 24(%rsp)
	jmp	.LBB0_40
.LBB0_35:
	movq	112(%rsp), %rdx
	leaq	448(%r13), %rcx
	xorl	%esi, %esi
	addq	%rax, %rcx
	.p2align	4
.LBB0_36:
	vmovupd	%zmm0, 12288(%r13,%rsi,8)
	vmovupd	%zmm1, 12544(%r13,%rsi,8)
	addq	$8, %rdx
	vmovups	-448(%rcx,%rsi,8), %zmm2
	vmovups	%zmm2, 14080(%r13,%rsi,8)
	vmovupd	%zmm0, 12352(%r13,%rsi,8)
	vmovupd	%zmm1, 12608(%r13,%rsi,8)
	vmovups	-384(%rcx,%rsi,8), %zmm2
	vmovups	%zmm2, 14144(%r13,%rsi,8)
	vmovupd	%zmm0, 12416(%r13,%rsi,8)
	vmovupd	%zmm1, 12672(%r13,%rsi,8)
	vmovups	-320(%rcx,%rsi,8), %zmm2
	vmovups	%zmm2, 14208(%r13,%rsi,8)
	vmovupd	%zmm0, 12480(%r13,%rsi,8)
	vmovupd	%zmm1, 12736(%r13,%rsi,8)
	vmovups	-256(%rcx,%rsi,8), %zmm2
	vmovups	%zmm2, 14272(%r13,%rsi,8)
	vmovupd	%zmm0, 12544(%r13,%rsi,8)
	vmovupd	%zmm1, 12800(%r13,%rsi,8)
	vmovups	-192(%rcx,%rsi,8), %zmm2
	vmovups	%zmm2, 14336(%r13,%rsi,8)
	vmovupd	%zmm0, 12608(%r13,%rsi,8)
	vmovupd	%zmm1, 12864(%r13,%rsi,8)
	vmovups	-128(%rcx,%rsi,8), %zmm2
	vmovups	%zmm2, 14400(%r13,%rsi,8)
	vmovupd	%zmm0, 12672(%r13,%rsi,8)
	vmovupd	%zmm1, 12928(%r13,%rsi,8)
	vmovups	-64(%rcx,%rsi,8), %zmm2
	vmovups	%zmm2, 14464(%r13,%rsi,8)
	vmovupd	%zmm0, 12736(%r13,%rsi,8)
	vmovupd	%zmm1, 12992(%r13,%rsi,8)
	vmovupd	(%rcx,%rsi,8), %zmm2
	vmovupd	%zmm2, 14528(%r13,%rsi,8)
	leaq	64(%rsi), %rsi
	jne	.LBB0_36
	testb	$7, 80(%rsp)
	je	.LBB0_40
.LBB0_38:
	leaq	12288(%r13), %rcx
	leaq	(%rax,%rsi,8), %rax
	xorl	%edx, %edx
	leaq	(%rcx,%rsi,8), %rcx
	addq	%r13, %rax
	.p2align	4
.LBB0_39:
	vmovupd	%zmm0, (%rcx,%rdx)
	vmovupd	%zmm1, 256(%rcx,%rdx)
	vmovupd	(%rax,%rdx), %zmm2
	vmovupd	%zmm2, 1792(%rcx,%rdx)
	addq	$64, %rdx
	cmpq	%rdx, %r12
	jne	.LBB0_39
.LBB0_40:
	movq	56(%rsp), %rax
	movq	1800(%rsp), %rdx
	movq	1808(%rsp), %rcx
	movq	1816(%rsp), %r8
	movq	1824(%rsp), %r9
	leaq	688(%rsp), %rdi
	leaq	680(%rsp), %rsi
	vmovsd	(%rax,%r15,8), %xmm0
	pushq	2584(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	24(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2128(%rsp)
	.cfi_adjust_cfa_offset 8
	movq	1728(%rsp), %rax
	pushq	16(%rax,%r14,8)
	.cfi_adjust_cfa_offset 8
	pushq	360(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r15
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1856(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2224(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r13
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9correctedB3v52B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdxx5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedExx, %rax
	vzeroupper
	callq	*%rax
	addq	$400, %rsp
	.cfi_adjust_cfa_offset -400
	cmpl	$-2, %eax
	je	.LBB0_24
	vmovsd	8(%rsp), %xmm2
	testl	%eax, %eax
	je	.LBB0_25
	jmp	.LBB0_111
.LBB0_42:
	cmpq	$0, 2584(%rsp)
	vxorpd	%xmm3, %xmm3, %xmm3
	jle	.LBB0_24
	cmpq	$40, 2584(%rsp)
	jb	.LBB0_48
	movq	520(%rsp), %r8
	leaq	(%r9,%r8), %r10
	movq	512(%rsp), %r8
	leaq	(%r9,%r8), %r11
	xorl	%r8d, %r8d
	cmpq	%r9, %r10
	setb	%r8b
	xorl	%r10d, %r10d
	cmpq	%r9, %r11
	movq	504(%rsp), %r9
	seta	%r10b
	cmpq	$0, 176(%rsp)
	cmovsl	%r10d, %r8d
	leaq	(%rdi,%r9), %r10
	movq	496(%rsp), %r9
	orb	6(%rsp), %r8b
	leaq	(%rdi,%r9), %r11
	xorl	%r9d, %r9d
	cmpq	%rdi, %r10
	setb	%r9b
	xorl	%r10d, %r10d
	cmpq	%rdi, %r11
	seta	%r10b
	cmpq	$0, 168(%rsp)
	cmovsl	%r10d, %r9d
	testb	%r8b, %r8b
	jne	.LBB0_48
	orb	5(%rsp), %r9b
	movl	$0, %edi
	jne	.LBB0_49
	addq	$8, %rsi
	cmpq	%rsi, %rcx
	jae	.LBB0_59
	addq	$8, %rax
	cmpq	%rax, %rdx
	jae	.LBB0_59
.LBB0_48:
	xorl	%edi, %edi
.LBB0_49:
	cmpq	$0, 264(%rsp)
	movq	%rdi, %rax
	je	.LBB0_53
	movq	168(%rsp), %r8
	movq	176(%rsp), %rsi
	movq	528(%rsp), %r9
	movabsq	$4594902181429758083, %r10
	xorl	%edx, %edx
	movq	%r8, %rax
	imulq	%rdi, %rax
	movq	%rsi, %rcx
	imulq	%rdi, %rcx
	addq	%rbx, %rax
	addq	%rbp, %rcx
.LBB0_51:
	movq	$0, (%rcx)
	movq	%r10, (%rax)
	addq	%r8, %rax
	addq	%rsi, %rcx
	decq	%rdx
	cmpq	%rdx, %r9
	jne	.LBB0_51
	movq	%rdi, %rax
	subq	%rdx, %rax
.LBB0_53:
	subq	2584(%rsp), %rdi
	cmpq	$-8, %rdi
	ja	.LBB0_24
	movq	168(%rsp), %r11
	movq	176(%rsp), %r10
	leaq	6(%rax), %rdi
	leaq	5(%rax), %r8
	leaq	7(%rax), %rcx
	movq	488(%rsp), %r14
	movq	%r11, %rsi
	imulq	%rdi, %rsi
	imulq	%r10, %rdi
	movq	%r10, %r9
	imulq	%rax, %r9
	movq	%r11, %rdx
	imulq	%rcx, %rdx
	imulq	%r10, %rcx
	movq	%rsi, 440(%rsp)
	movq	%r11, %rsi
	imulq	%r8, %rsi
	movq	%rdi, 448(%rsp)
	imulq	%r10, %r8
	leaq	4(%rax), %rdi
	movq	%rcx, 464(%rsp)
	movabsq	$4594902181429758083, %rcx
	movq	%rdx, 456(%rsp)
	movq	%rbx, %rdx
	movq	%rsi, 424(%rsp)
	movq	%r11, %rsi
	imulq	%rdi, %rsi
	movq	%r8, 432(%rsp)
	imulq	%r10, %rdi
	leaq	3(%rax), %r8
	movq	%rsi, 408(%rsp)
	movq	%r11, %rsi
	imulq	%r8, %rsi
	movq	%rdi, 416(%rsp)
	leaq	2(%rax), %rdi
	imulq	%r10, %r8
	movq	%rsi, 392(%rsp)
	movq	%r11, %rsi
	imulq	%rdi, %rsi
	imulq	%r10, %rdi
	movq	%r8, 400(%rsp)
	leaq	1(%rax), %r8
	movq	%rsi, 376(%rsp)
	movq	%r11, %rsi
	imulq	%rax, %rsi
	movq	%rdi, 384(%rsp)
	addq	472(%rsp), %rax
	movq	480(%rsp), %rdi
	imulq	%r8, %r11
	imulq	%r10, %r8
	movq	%rbp, %r10
	movq	%rsi, 368(%rsp)
.LBB0_57:
	movq	368(%rsp), %rsi
	movq	$0, (%r10,%r9)
	movq	%rcx, (%rdx,%rsi)
	movq	384(%rsp), %rsi
	movq	$0, (%r10,%r8)
	movq	%rcx, (%rdx,%r11)
	movq	$0, (%r10,%rsi)
	movq	376(%rsp), %rsi
	movq	%rcx, (%rdx,%rsi)
	movq	400(%rsp), %rsi
	movq	$0, (%r10,%rsi)
	movq	392(%rsp), %rsi
	movq	%rcx, (%rdx,%rsi)
	movq	416(%rsp), %rsi
	movq	$0, (%r10,%rsi)
	movq	408(%rsp), %rsi
	movq	%rcx, (%rdx,%rsi)
	movq	432(%rsp), %rsi
	movq	$0, (%r10,%rsi)
	movq	424(%rsp), %rsi
	movq	%rcx, (%rdx,%rsi)
	movq	448(%rsp), %rsi
	movq	$0, (%r10,%rsi)
	movq	440(%rsp), %rsi
	movq	%rcx, (%rdx,%rsi)
	movq	464(%rsp), %rsi
	movq	$0, (%r10,%rsi)
	movq	456(%rsp), %rsi
	addq	%r14, %r10
	movq	%rcx, (%rdx,%rsi)
	addq	%rdi, %rdx
	addq	$8, %rax
	jne	.LBB0_57
	jmp	.LBB0_24
.LBB0_59:
	vmovdqu64	720(%rsp), %zmm0
	movq	544(%rsp), %rax
	movq	536(%rsp), %rcx
	movq	88(%rsp), %rdx
	leaq	(%rax,%r15,8), %rax
	leaq	(%rcx,%r15,8), %rcx
.LBB0_60:
	vpmullq	848(%rsp), %zmm0, %zmm1
	kxnorb	%k0, %k0, %k1
	addq	$-8, %rdx
	vscatterqpd	%zmm3, (%rax,%zmm1,8) {%k1}
	kxnorb	%k0, %k0, %k1
	vpmullq	784(%rsp), %zmm0, %zmm1
	vmovupd	976(%rsp), %zmm2
	vscatterqpd	%zmm2, (%rcx,%zmm1,8) {%k1}
	vpaddq	912(%rsp), %zmm0, %zmm0
	jne	.LBB0_60
	movq	88(%rsp), %rax
	movq	%rax, %rdi
	cmpq	%rax, 2584(%rsp)
	je	.LBB0_24
	jmp	.LBB0_49
	.p2align	4
.LBB0_63:
	cmpq	$0, 2584(%rsp)
	movq	640(%rsp), %rdi
	movq	264(%rsp), %r8
	movq	2152(%rsp), %r9
	movq	1688(%rsp), %rbp
	movq	16(%rsp), %r10
	movq	24(%rsp), %r11
	jle	.LBB0_169
	xorl	%eax, %eax
	xorl	%ecx, %ecx
	cmpq	$8, 2584(%rsp)
	leaq	1(%r10), %rbx
	jb	.LBB0_93
	movq	88(%rsp), %rdx
	movq	568(%rsp), %rsi
	jmp	.LBB0_67
	.p2align	4
.LBB0_66:
	addq	$8, %rcx
	cmpq	%rcx, %rdx
	je	.LBB0_92
.LBB0_67:
	vmovsd	-56(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_68
	movb	$1, %al
	movq	%rbx, (%r9,%rcx,8)
	vmovsd	-48(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	ja	.LBB0_76
.LBB0_69:
	vmovsd	-40(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_70
.LBB0_77:
	movb	$1, %al
	movq	%rbx, 16(%r9,%rcx,8)
	vmovsd	-32(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	ja	.LBB0_78
.LBB0_71:
	vmovsd	-24(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_72
.LBB0_79:
	movb	$1, %al
	movq	%rbx, 32(%r9,%rcx,8)
	vmovsd	-16(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	ja	.LBB0_80
.LBB0_73:
	vmovsd	-8(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_74
.LBB0_81:
	movb	$1, %al
	movq	%rbx, 48(%r9,%rcx,8)
	vmovsd	(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_66
	jmp	.LBB0_82
	.p2align	4
.LBB0_68:
	vmovsd	-48(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_69
.LBB0_76:
	movb	$1, %al
	movq	%rbx, 8(%r9,%rcx,8)
	vmovsd	-40(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	ja	.LBB0_77
.LBB0_70:
	vmovsd	-32(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_71
.LBB0_78:
	movb	$1, %al
	movq	%rbx, 24(%r9,%rcx,8)
	vmovsd	-24(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	ja	.LBB0_79
.LBB0_72:
	vmovsd	-16(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_73
.LBB0_80:
	movb	$1, %al
	movq	%rbx, 40(%r9,%rcx,8)
	vmovsd	-8(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	ja	.LBB0_81
.LBB0_74:
	vmovsd	(%rsi,%rcx,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_66
.LBB0_82:
	movb	$1, %al
	movq	%rbx, 56(%r9,%rcx,8)
	jmp	.LBB0_66
	.p2align	4
.LBB0_83:
	movq	584(%rsp), %rax
	movq	592(%rsp), %rcx
	xorl	%edx, %edx
	jmp	.LBB0_85
	.p2align	4
.LBB0_84:
	incq	%rdx
	addq	$512, %rcx
	addq	$512, %rax
	cmpq	%rdx, 336(%rsp)
	je	.LBB0_20
.LBB0_85:
	movq	48(%rsp), %rsi
	addq	%rdx, %rsi
	movq	%rsi, %rdi
	sarq	$63, %rdi
	andq	%rbp, %rdi
	leaq	(%rdi,%rsi,2), %rsi
	movq	1680(%rsp), %rdi
	imulq	%r15, %rsi
	vcvttsd2si	(%rdi,%rsi,8), %r8
	movq	%r8, %rsi
	movq	%r8, %rdi
	shlq	$8, %rsi
	shlq	$9, %rdi
	cmpq	$7, 40(%rsp)
	jae	.LBB0_87
	xorl	%r14d, %r14d
	jmp	.LBB0_90
	.p2align	4
.LBB0_87:
	leaq	(%r8,%r8,2), %r11
	leaq	960(%r13), %rbx
	leaq	1472(%r13), %r9
	leaq	1216(%r13), %r10
	xorl	%r14d, %r14d
	addq	%rsi, %r9
	addq	%rdi, %r10
	shlq	$8, %r11
	addq	%rbx, %r11
	movq	112(%rsp), %rbx
	.p2align	4
.LBB0_88:
	vmovupd	%zmm1, -1472(%r9,%r14,8)
	vmovupd	%zmm1, -960(%r9,%r14,8)
	vmovupd	%zmm1, -704(%r10,%r14,8)
	vmovupd	%zmm1, -448(%r9,%r14,8)
	vmovupd	%zmm1, -448(%r10,%r14,8)
	addq	$8, %rbx
	vmovups	-448(%rcx,%r14,8), %zmm0
	vmovups	%zmm0, -448(%r11,%r14,8)
	vmovupd	%zmm1, -1408(%r9,%r14,8)
	vmovupd	%zmm1, -896(%r9,%r14,8)
	vmovupd	%zmm1, -640(%r10,%r14,8)
	vmovupd	%zmm1, -384(%r9,%r14,8)
	vmovupd	%zmm1, -384(%r10,%r14,8)
	vmovups	-384(%rcx,%r14,8), %zmm0
	vmovups	%zmm0, -384(%r11,%r14,8)
	vmovupd	%zmm1, -1344(%r9,%r14,8)
	vmovupd	%zmm1, -832(%r9,%r14,8)
	vmovupd	%zmm1, -576(%r10,%r14,8)
	vmovupd	%zmm1, -320(%r9,%r14,8)
	vmovupd	%zmm1, -320(%r10,%r14,8)
	vmovups	-320(%rcx,%r14,8), %zmm0
	vmovups	%zmm0, -320(%r11,%r14,8)
	vmovupd	%zmm1, -1280(%r9,%r14,8)
	vmovupd	%zmm1, -768(%r9,%r14,8)
	vmovupd	%zmm1, -512(%r10,%r14,8)
	vmovupd	%zmm1, -256(%r9,%r14,8)
	vmovupd	%zmm1, -256(%r10,%r14,8)
	vmovups	-256(%rcx,%r14,8), %zmm0
	vmovups	%zmm0, -256(%r11,%r14,8)
	vmovupd	%zmm1, -1216(%r9,%r14,8)
	vmovupd	%zmm1, -704(%r9,%r14,8)
	vmovupd	%zmm1, -448(%r10,%r14,8)
	vmovupd	%zmm1, -192(%r9,%r14,8)
	vmovupd	%zmm1, -192(%r10,%r14,8)
	vmovups	-192(%rcx,%r14,8), %zmm0
	vmovups	%zmm0, -192(%r11,%r14,8)
	vmovupd	%zmm1, -1152(%r9,%r14,8)
	vmovupd	%zmm1, -640(%r9,%r14,8)
	vmovupd	%zmm1, -384(%r10,%r14,8)
	vmovupd	%zmm1, -128(%r9,%r14,8)
	vmovupd	%zmm1, -128(%r10,%r14,8)
	vmovups	-128(%rcx,%r14,8), %zmm0
	vmovups	%zmm0, -128(%r11,%r14,8)
	vmovupd	%zmm1, -1088(%r9,%r14,8)
	vmovupd	%zmm1, -576(%r9,%r14,8)
	vmovupd	%zmm1, -320(%r10,%r14,8)
	vmovupd	%zmm1, -64(%r9,%r14,8)
	vmovupd	%zmm1, -64(%r10,%r14,8)
	vmovups	-64(%rcx,%r14,8), %zmm0
	vmovups	%zmm0, -64(%r11,%r14,8)
	vmovupd	%zmm1, -1024(%r9,%r14,8)
	vmovupd	%zmm1, -512(%r9,%r14,8)
	vmovupd	%zmm1, -256(%r10,%r14,8)
	vmovupd	%zmm1, (%r9,%r14,8)
	vmovupd	%zmm1, (%r10,%r14,8)
	vmovdqu64	(%rcx,%r14,8), %zmm0
	vmovdqu64	%zmm0, (%r11,%r14,8)
	leaq	64(%r14), %r14
	jne	.LBB0_88
	cmpq	$0, 32(%rsp)
	je	.LBB0_84
.LBB0_90:
	leaq	(%r8,%r8,2), %r8
	leaq	(%rdi,%r14,8), %rdi
	leaq	512(%r13), %r10
	leaq	(%rsi,%r14,8), %rsi
	leaq	(%rax,%r14,8), %r9
	shlq	$8, %r8
	leaq	(%r8,%r14,8), %r8
	addq	%r10, %r8
	leaq	768(%r13), %r10
	addq	%r10, %rdi
	leaq	1024(%r13), %r10
	addq	%r10, %rsi
	xorl	%r10d, %r10d
	.p2align	4
.LBB0_91:
	vmovupd	%zmm1, -1024(%rsi,%r10)
	vmovupd	%zmm1, -512(%rsi,%r10)
	vmovupd	%zmm1, -256(%rdi,%r10)
	vmovupd	%zmm1, (%rsi,%r10)
	vmovupd	%zmm1, (%rdi,%r10)
	vmovdqu64	(%r9,%r10), %zmm0
	vmovdqu64	%zmm0, (%r8,%r10)
	addq	$64, %r10
	cmpq	%r10, %r12
	jne	.LBB0_91
	jmp	.LBB0_84
	.p2align	4
.LBB0_92:
	movq	2584(%rsp), %rdx
	testb	$7, %dl
	je	.LBB0_97
.LBB0_93:
	movq	608(%rsp), %rsi
	leaq	(%r9,%rcx,8), %rdx
	leaq	(%rsi,%rcx,8), %rcx
	xorl	%esi, %esi
	jmp	.LBB0_95
	.p2align	4
.LBB0_94:
	incq	%rsi
	cmpq	%rsi, %r8
	je	.LBB0_97
.LBB0_95:
	vmovsd	(%rcx,%rsi,8), %xmm0
	vucomisd	%xmm2, %xmm0
	jbe	.LBB0_94
	movb	$1, %al
	movq	%rbx, (%rdx,%rsi,8)
	jmp	.LBB0_94
	.p2align	4
.LBB0_97:
	testq	%r11, %r11
	jne	.LBB0_169
	testb	$1, %al
	je	.LBB0_169
	cmpq	$1, 2216(%rsp)
	jle	.LBB0_101
	vmovsd	(%r13), %xmm0
	movq	%r10, %rax
	imulq	2224(%rsp), %rax
	movq	2208(%rsp), %r8
	movq	296(%rsp), %rdx
	movq	560(%rsp), %rcx
	movq	2280(%rsp), %rsi
	movabsq	$4607182418800017408, %r9
	imulq	%r10, %rcx
	vmovsd	%xmm0, (%r8,%rax,8)
	vmovsd	(%r13,%rdx), %xmm0
	movq	256(%rsp), %rdx
	vmovsd	%xmm0, (%rsi,%rcx,8)
	movq	%r9, (%r13,%rdx)
	movq	280(%rsp), %rdx
	vmovsd	(%r13,%rdx), %xmm0
	movq	248(%rsp), %rdx
	vmovsd	%xmm0, 8(%rsi,%rcx,8)
	movq	$0, (%r13,%rdx)
	movq	1848(%rsp), %rdx
	leaq	(%rsi,%rcx,8), %rsi
	movq	288(%rsp), %rcx
	vmovsd	(%r13,%rdx,8), %xmm0
	movq	240(%rsp), %rdx
	vmovsd	%xmm0, 8(%r8,%rax,8)
	movq	232(%rsp), %rax
	vmovsd	(%r13,%rcx), %xmm0
	movq	2304(%rsp), %rcx
	vmovsd	%xmm0, (%rsi,%rcx,8)
	movq	$0, (%r13,%rdx)
	movq	272(%rsp), %rdx
	vmovsd	(%r13,%rdx), %xmm0
	vmovsd	%xmm0, 8(%rsi,%rcx,8)
	movq	%r9, (%r13,%rax)
.LBB0_101:
	cmpq	%rdi, %r10
	je	.LBB0_148
	movzbl	7(%rsp), %ecx
	vmovsd	632(%rsp), %xmm0
	vmovsd	96(%rsp), %xmm1
	xorl	%eax, %eax
	movq	328(%rsp), %rdx
	movq	200(%rsp), %r8
	movq	1104(%rsp), %r9
	movq	$0, 208(%rsp)
	leaq	208(%rsp), %rdi
	leaq	344(%rsp), %rsi
	movb	%cl, %al
	movq	192(%rsp), %rcx
	pushq	2584(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	176(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	72(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1824(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	144(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1472(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r13
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2200(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1616(%rsp)
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7crossedB3v53B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxddxxbx, %rax
	vzeroupper
	callq	*%rax
	addq	$512, %rsp
	.cfi_adjust_cfa_offset -512
	testl	%eax, %eax
	jne	.LBB0_170
	vmovsd	8(%rsp), %xmm2
	movq	208(%rsp), %rax
	movq	1480(%rsp), %rcx
	vxorpd	%xmm1, %xmm1, %xmm1
	movq	%rax, 24(%rsp)
	testq	%rcx, %rcx
	jle	.LBB0_109
	movq	576(%rsp), %r14
	xorl	%r15d, %r15d
	jmp	.LBB0_106
	.p2align	4
.LBB0_105:
	addq	120(%rsp), %r14
	incq	%r15
	cmpq	%r15, %rcx
	je	.LBB0_109
.LBB0_106:
	movq	(%r14), %rax
	testq	%rax, %rax
	js	.LBB0_105
	movq	1880(%rsp), %rcx
	movq	1872(%rsp), %rdx
	movq	1888(%rsp), %r8
	movq	1896(%rsp), %r9
	leaq	672(%rsp), %rdi
	leaq	664(%rsp), %rsi
	pushq	2584(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	168(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	%r15
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1672(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2040(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2040(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2040(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2040(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	2040(%rsp)
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5fadedB3v56B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxx, %rax
	vzeroupper
	callq	*%rax
	vmovsd	152(%rsp), %xmm2
	movq	1624(%rsp), %rcx
	vxorpd	%xmm1, %xmm1, %xmm1
	addq	$144, %rsp
	.cfi_adjust_cfa_offset -144
	testl	%eax, %eax
	je	.LBB0_105
	cmpl	$-2, %eax
	je	.LBB0_105
	jmp	.LBB0_111
	.p2align	4
.LBB0_109:
	cmpq	$1, 2216(%rsp)
	jle	.LBB0_18
	movq	256(%rsp), %rcx
	movq	16(%rsp), %rsi
	movq	2528(%rsp), %rdx
	imulq	552(%rsp), %rsi
	vmovsd	(%r13,%rcx), %xmm0
	movq	248(%rsp), %rcx
	leaq	(%rdx,%rsi,8), %rax
	vmovsd	%xmm0, (%rdx,%rsi,8)
	vmovsd	(%r13,%rcx), %xmm0
	movq	240(%rsp), %rcx
	vmovsd	%xmm0, 8(%rdx,%rsi,8)
	movq	232(%rsp), %rdx
	vmovsd	(%r13,%rcx), %xmm0
	movq	2552(%rsp), %rcx
	vmovsd	%xmm0, (%rax,%rcx,8)
	vmovsd	(%r13,%rdx), %xmm0
	vmovsd	%xmm0, 8(%rax,%rcx,8)
	jmp	.LBB0_18
.LBB0_111:
	movq	64(%rsp), %rcx
	movq	$0, (%rcx)
	jmp	.LBB0_150
.LBB0_112:
	movq	48(%rsp), %rcx
	vbroadcastsd	%xmm0, %zmm1
	movq	%rcx, %rax
	sarq	$63, %rax
	andnq	%rcx, %rax, %rdx
	movq	160(%rsp), %rcx
	movq	1480(%rsp), %rax
	leaq	(%rdx,%rdx), %rsi
	movq	%rsi, 16(%rsp)
	leaq	4(%rcx), %r9
	imulq	%rcx, %r9
	movq	%r9, 56(%rsp)
	testq	%rax, %rax
	jle	.LBB0_151
	movq	1904(%rsp), %r10
	leaq	3(%rcx), %r8
	movabsq	$9223372036854775800, %rcx
	movq	%rdx, %rdi
	movq	%rsi, %r11
	movl	%eax, %esi
	movl	%r9d, %ebx
	andl	$3, %esi
	andl	$3, %edi
	andl	$7, %ebx
	leaq	16384(%r13), %rbp
	vpxor	%xmm3, %xmm3, %xmm3
	leaq	4(%rcx), %rdx
	andq	%rcx, %r11
	andq	%rcx, %r9
	shll	$9, %edi
	movq	%rbx, 352(%rsp)
	shll	$8, %ebx
	movq	%rsi, 96(%rsp)
	andq	%rax, %rdx
	leaq	14592(%r13), %rax
	movq	%r9, 72(%rsp)
	movq	1680(%rsp), %r9
	movq	%rdi, 32(%rsp)
	movq	%r11, 104(%rsp)
	movq	%rax, 152(%rsp)
	leaq	1792(%r10), %rax
	movq	%r10, 144(%rsp)
	movq	%rax, 120(%rsp)
	movq	1536(%rsp), %rax
	leaq	1792(%r9), %r12
	movq	%r9, 136(%rsp)
	addq	$16, %rax
	movq	%rax, 24(%rsp)
	movq	1608(%rsp), %rax
	leaq	4096(%rax), %rcx
	addq	$256, %rax
	movq	%rax, 8(%rsp)
	movl	%esi, %eax
	shll	$8, %eax
	movq	%rcx, 128(%rsp)
	movabsq	$.LCPI0_5, %rcx
	xorl	%esi, %esi
	leaq	(%rax,%rax,4), %r14
	movq	1552(%rsp), %rax
	vpbroadcastq	(%rcx), %zmm2
	leaq	(,%rax,8), %rcx
	movq	80(%rsp), %rax
	jmp	.LBB0_115
	.p2align	4
.LBB0_114:
	movq	40(%rsp), %rax
	addq	$64, 152(%rsp)
	addq	$64, 136(%rsp)
	addq	$64, 120(%rsp)
	addq	$64, 144(%rsp)
	addq	$64, 128(%rsp)
	addq	$64, 8(%rsp)
	movq	104(%rsp), %r11
	vmovdqu64	%zmm2, 13568(%r13,%rsi,8)
	vmovupd	%zmm1, 13312(%r13,%rsi,8)
	addq	$8, %rsi
	addq	$64, %r12
	addq	$64, %rbp
	cmpq	$1, %rax
	leaq	-1(%rax), %rax
	jle	.LBB0_16
.LBB0_115:
	movq	1752(%rsp), %rdi
	movq	16(%rsp), %r9
	movq	56(%rsp), %r10
	movq	%rax, 40(%rsp)
	vmovups	(%rdi,%rsi,8), %zmm4
	vmovups	%zmm4, (%r13,%rsi,8)
	vmovups	256(%rdi,%rsi,8), %zmm4
	vmovups	%zmm4, 256(%r13,%rsi,8)
	vmovups	512(%rdi,%rsi,8), %zmm4
	vmovups	%zmm4, 512(%r13,%rsi,8)
	vmovups	768(%rdi,%rsi,8), %zmm4
	vmovups	%zmm4, 768(%r13,%rsi,8)
	vmovups	1024(%rdi,%rsi,8), %zmm4
	vmovups	%zmm4, 1024(%r13,%rsi,8)
	vmovdqu64	1280(%rdi,%rsi,8), %zmm4
	vmovdqu64	%zmm4, 1280(%r13,%rsi,8)
	testq	%r9, %r9
	jle	.LBB0_123
	cmpq	$4, 48(%rsp)
	jge	.LBB0_118
	movq	32(%rsp), %r15
	xorl	%eax, %eax
	jmp	.LBB0_121
	.p2align	4
.LBB0_118:
	xorl	%edi, %edi
	xorl	%eax, %eax
	.p2align	4
.LBB0_119:
	vmovups	-1792(%r12,%rdi), %zmm4
	addq	$8, %rax
	vmovups	%zmm4, -1792(%rbp,%rdi)
	vmovups	-1536(%r12,%rdi), %zmm4
	vmovups	%zmm4, -1536(%rbp,%rdi)
	vmovups	-1280(%r12,%rdi), %zmm4
	vmovups	%zmm4, -1280(%rbp,%rdi)
	vmovups	-1024(%r12,%rdi), %zmm4
	vmovups	%zmm4, -1024(%rbp,%rdi)
	vmovups	-768(%r12,%rdi), %zmm4
	vmovups	%zmm4, -768(%rbp,%rdi)
	vmovups	-512(%r12,%rdi), %zmm4
	vmovups	%zmm4, -512(%rbp,%rdi)
	vmovups	-256(%r12,%rdi), %zmm4
	vmovups	%zmm4, -256(%rbp,%rdi)
	vmovdqu64	(%r12,%rdi), %zmm4
	vmovdqu64	%zmm4, (%rbp,%rdi)
	addq	$2048, %rdi
	cmpq	%rax, %r11
	jne	.LBB0_119
	movq	32(%rsp), %r15
	testb	$6, %r9b
	je	.LBB0_123
.LBB0_121:
	movq	152(%rsp), %rdi
	shlq	$8, %rax
	xorl	%r9d, %r9d
	addq	%rax, %rdi
	addq	136(%rsp), %rax
	.p2align	4
.LBB0_122:
	vmovdqu64	(%rax,%r9), %zmm4
	vmovdqu64	%zmm4, (%rdi,%r9)
	addq	$256, %r9
	cmpq	%r9, %r15
	jne	.LBB0_122
.LBB0_123:
	testq	%r10, %r10
	jle	.LBB0_131
	cmpq	$8, %r10
	jae	.LBB0_126
	xorl	%eax, %eax
	jmp	.LBB0_129
	.p2align	4
.LBB0_126:
	movq	120(%rsp), %rdi
	movq	72(%rsp), %r9
	xorl	%eax, %eax
	.p2align	4
.LBB0_127:
	vmovdqu64	%zmm3, -1792(%rdi)
	vmovdqu64	%zmm3, -1536(%rdi)
	vmovdqu64	%zmm3, -1280(%rdi)
	vmovdqu64	%zmm3, -1024(%rdi)
	vmovdqu64	%zmm3, -768(%rdi)
	vmovdqu64	%zmm3, -512(%rdi)
	vmovdqu64	%zmm3, -256(%rdi)
	vmovdqu64	%zmm3, (%rdi)
	addq	$8, %rax
	addq	$2048, %rdi
	cmpq	%rax, %r9
	jne	.LBB0_127
	cmpq	$0, 352(%rsp)
	je	.LBB0_131
.LBB0_129:
	shlq	$8, %rax
	addq	144(%rsp), %rax
	xorl	%edi, %edi
	.p2align	4
.LBB0_130:
	vmovdqu64	%zmm3, (%rax,%rdi)
	addq	$256, %rdi
	cmpq	%rdi, %rbx
	jne	.LBB0_130
.LBB0_131:
	movq	1904(%rsp), %rax
	cmpq	$4, 1480(%rsp)
	leaq	(%rax,%rsi,8), %rdi
	jae	.LBB0_133
	xorl	%r10d, %r10d
	jmp	.LBB0_144
	.p2align	4
.LBB0_133:
	movq	128(%rsp), %rax
	movq	24(%rsp), %r9
	xorl	%r10d, %r10d
	jmp	.LBB0_135
	.p2align	4
.LBB0_134:
	addq	%rcx, %r9
	addq	$4, %r10
	addq	$5120, %rax
	addq	%rcx, %r9
	cmpq	%r10, %rdx
	je	.LBB0_143
.LBB0_135:
	movq	(%r9), %r15
	testq	%r15, %r15
	js	.LBB0_137
	vmovdqu64	-3840(%rax), %zmm4
	movq	%r15, %r11
	imulq	%r8, %r11
	addq	%r15, %r11
	shlq	$8, %r11
	vmovdqu64	%zmm4, 768(%r11,%rdi)
.LBB0_137:
	movq	(%r9,%rcx), %r11
	testq	%r11, %r11
	js	.LBB0_139
	vmovdqu64	-2560(%rax), %zmm4
	movq	%r11, %r15
	imulq	%r8, %r15
	addq	%r11, %r15
	shlq	$8, %r15
	vmovdqu64	%zmm4, 768(%r15,%rdi)
.LBB0_139:
	addq	%rcx, %r9
	movq	(%r9,%rcx), %r11
	testq	%r11, %r11
	js	.LBB0_141
	vmovdqu64	-1280(%rax), %zmm4
	movq	%r11, %r15
	imulq	%r8, %r15
	addq	%r11, %r15
	shlq	$8, %r15
	vmovdqu64	%zmm4, 768(%r15,%rdi)
.LBB0_141:
	addq	%rcx, %r9
	movq	(%r9,%rcx), %r11
	testq	%r11, %r11
	js	.LBB0_134
	vmovdqu64	(%rax), %zmm4
	movq	%r11, %r15
	imulq	%r8, %r15
	addq	%r11, %r15
	shlq	$8, %r15
	vmovdqu64	%zmm4, 768(%r15,%rdi)
	jmp	.LBB0_134
	.p2align	4
.LBB0_143:
	cmpq	$0, 96(%rsp)
	je	.LBB0_114
.LBB0_144:
	leaq	(%r10,%r10,4), %rax
	imulq	%rcx, %r10
	addq	24(%rsp), %r10
	xorl	%r9d, %r9d
	shlq	$8, %rax
	addq	8(%rsp), %rax
	jmp	.LBB0_146
	.p2align	4
.LBB0_145:
	addq	$1280, %r9
	addq	%rcx, %r10
	cmpq	%r9, %r14
	je	.LBB0_114
.LBB0_146:
	movq	(%r10), %r11
	testq	%r11, %r11
	js	.LBB0_145
	vmovdqu64	(%rax,%r9), %zmm4
	movq	%r11, %r15
	imulq	%r8, %r15
	addq	%r11, %r15
	shlq	$8, %r15
	vmovdqu64	%zmm4, 768(%r15,%rdi)
	jmp	.LBB0_145
.LBB0_148:
	movq	224(%rsp), %rax
	movq	$0, (%rax)
.LBB0_149:
	xorl	%eax, %eax
.LBB0_150:
	addq	$1048, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.LBB0_151:
	.cfi_def_cfa_offset 1104
	andl	$3, %edx
	movq	1680(%rsp), %r14
	movq	1904(%rsp), %rbx
	movabsq	$9223372036854775800, %rcx
	movq	%rsi, %rax
	movq	%r9, %rsi
	movl	%r9d, %r11d
	andl	$7, %r11d
	leaq	16384(%r13), %r8
	leaq	14592(%r13), %r9
	xorl	%r12d, %r12d
	vpxor	%xmm3, %xmm3, %xmm3
	shll	$9, %edx
	andq	%rcx, %rax
	andq	%rcx, %rsi
	movq	80(%rsp), %rcx
	movq	%r11, 8(%rsp)
	shll	$8, %r11d
	movq	%rdx, 32(%rsp)
	movabsq	$.LCPI0_5, %rdx
	vpbroadcastq	(%rdx), %zmm2
	movq	32(%rsp), %rdx
	leaq	1792(%r14), %rdi
	leaq	1792(%rbx), %r10
	jmp	.LBB0_153
	.p2align	4
.LBB0_152:
	movq	40(%rsp), %rcx
	vmovdqu64	%zmm2, 13568(%r13,%r12,8)
	vmovupd	%zmm1, 13312(%r13,%r12,8)
	addq	$8, %r12
	addq	$64, %rdi
	addq	$64, %r8
	addq	$64, %r9
	addq	$64, %r14
	addq	$64, %r10
	addq	$64, %rbx
	cmpq	$1, %rcx
	leaq	-1(%rcx), %rcx
	jbe	.LBB0_16
.LBB0_153:
	movq	1752(%rsp), %r15
	cmpq	$0, 16(%rsp)
	movq	%rcx, 40(%rsp)
	vmovups	(%r15,%r12,8), %zmm4
	vmovups	%zmm4, (%r13,%r12,8)
	vmovups	256(%r15,%r12,8), %zmm4
	vmovups	%zmm4, 256(%r13,%r12,8)
	vmovups	512(%r15,%r12,8), %zmm4
	vmovups	%zmm4, 512(%r13,%r12,8)
	vmovups	768(%r15,%r12,8), %zmm4
	vmovups	%zmm4, 768(%r13,%r12,8)
	vmovups	1024(%r15,%r12,8), %zmm4
	vmovups	%zmm4, 1024(%r13,%r12,8)
	vmovdqu64	1280(%r15,%r12,8), %zmm4
	vmovdqu64	%zmm4, 1280(%r13,%r12,8)
	jle	.LBB0_161
	cmpq	$4, 48(%rsp)
	jge	.LBB0_156
	xorl	%ebp, %ebp
	jmp	.LBB0_159
	.p2align	4
.LBB0_156:
	xorl	%ecx, %ecx
	xorl	%ebp, %ebp
	.p2align	4
.LBB0_157:
	vmovups	-1792(%rdi,%rcx), %zmm4
	addq	$8, %rbp
	vmovups	%zmm4, -1792(%r8,%rcx)
	vmovups	-1536(%rdi,%rcx), %zmm4
	vmovups	%zmm4, -1536(%r8,%rcx)
	vmovups	-1280(%rdi,%rcx), %zmm4
	vmovups	%zmm4, -1280(%r8,%rcx)
	vmovups	-1024(%rdi,%rcx), %zmm4
	vmovups	%zmm4, -1024(%r8,%rcx)
	vmovups	-768(%rdi,%rcx), %zmm4
	vmovups	%zmm4, -768(%r8,%rcx)
	vmovups	-512(%rdi,%rcx), %zmm4
	vmovups	%zmm4, -512(%r8,%rcx)
	vmovups	-256(%rdi,%rcx), %zmm4
	vmovups	%zmm4, -256(%r8,%rcx)
	vmovdqu64	(%rdi,%rcx), %zmm4
	vmovdqu64	%zmm4, (%r8,%rcx)
	addq	$2048, %rcx
	cmpq	%rbp, %rax
	jne	.LBB0_157
	testb	$6, 16(%rsp)
	je	.LBB0_161
.LBB0_159:
	shlq	$8, %rbp
	xorl	%r15d, %r15d
	leaq	(%r9,%rbp), %rcx
	addq	%r14, %rbp
	.p2align	4
.LBB0_160:
	vmovdqu64	(%rbp,%r15), %zmm4
	vmovdqu64	%zmm4, (%rcx,%r15)
	addq	$256, %r15
	cmpq	%r15, %rdx
	jne	.LBB0_160
.LBB0_161:
	cmpq	$0, 56(%rsp)
	jle	.LBB0_152
	cmpq	$8, 56(%rsp)
	jae	.LBB0_164
	xorl	%ebp, %ebp
	jmp	.LBB0_167
	.p2align	4
.LBB0_164:
	movq	%r10, %rcx
	xorl	%ebp, %ebp
	.p2align	4
.LBB0_165:
	vmovdqu64	%zmm3, -1792(%rcx)
	vmovdqu64	%zmm3, -1536(%rcx)
	vmovdqu64	%zmm3, -1280(%rcx)
	vmovdqu64	%zmm3, -1024(%rcx)
	vmovdqu64	%zmm3, -768(%rcx)
	vmovdqu64	%zmm3, -512(%rcx)
	vmovdqu64	%zmm3, -256(%rcx)
	vmovdqu64	%zmm3, (%rcx)
	addq	$8, %rbp
	addq	$2048, %rcx
	cmpq	%rbp, %rsi
	jne	.LBB0_165
	cmpq	$0, 8(%rsp)
	je	.LBB0_152
.LBB0_167:
	shlq	$8, %rbp
	xorl	%ecx, %ecx
	addq	%rbx, %rbp
	.p2align	4
.LBB0_168:
	vmovdqu64	%zmm3, (%rbp,%rcx)
	addq	$256, %rcx
	cmpq	%rcx, %r11
	jne	.LBB0_168
	jmp	.LBB0_152
.LBB0_169:
	movq	224(%rsp), %rax
	movq	%r11, (%rax)
	jmp	.LBB0_149
.LBB0_170:
	movq	344(%rsp), %rcx
	movq	64(%rsp), %rdx
	movq	%rcx, (%rdx)
	jmp	.LBB0_150
.Lfunc_end0:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx, .Lfunc_end0-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx
	.cfi_endproc

	.globl	_ZN7cpython42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx
	.p2align	4
	.type	_ZN7cpython42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx,@function
_ZN7cpython42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$2680, %rsp
	.cfi_def_cfa_offset 2736
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	%rsi, %rdi
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	leaq	880(%rsp), %r12
	movl	$21, %edx
	movl	$21, %ecx
	leaq	976(%rsp), %r14
	leaq	984(%rsp), %rbx
	leaq	992(%rsp), %r11
	leaq	1000(%rsp), %r10
	leaq	1008(%rsp), %rbp
	leaq	1016(%rsp), %r13
	movabsq	$.const.track, %rsi
	movabsq	$PyArg_UnpackTuple, %r15
	leaq	1040(%rsp), %r8
	leaq	1032(%rsp), %r9
	xorl	%eax, %eax
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	896(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	912(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	928(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	944(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	960(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	976(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	992(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	1008(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	1024(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	1040(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	leaq	1056(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	pushq	%r11
	.cfi_adjust_cfa_offset 8
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	%r13
	.cfi_adjust_cfa_offset 8
	leaq	1168(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	callq	*%r15
	addq	$160, %rsp
	.cfi_adjust_cfa_offset -160
	vxorps	%xmm0, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vmovups	%ymm1, 1104(%rsp)
	vmovups	%zmm0, 1760(%rsp)
	vmovups	%ymm1, 1040(%rsp)
	vmovups	%zmm0, 1664(%rsp)
	vmovups	%zmm0, 1568(%rsp)
	vmovups	%ymm1, 1936(%rsp)
	vmovups	%zmm0, 2536(%rsp)
	vmovups	%zmm0, 2440(%rsp)
	vmovups	%zmm0, 2344(%rsp)
	vmovups	%zmm0, 1488(%rsp)
	movq	$0, 1552(%rsp)
	vmovups	%ymm1, 1128(%rsp)
	vmovups	%zmm0, 1784(%rsp)
	vmovups	%ymm1, 1064(%rsp)
	vmovups	%zmm0, 1408(%rsp)
	movq	$0, 1472(%rsp)
	vmovups	%zmm0, 2080(%rsp)
	movq	$0, 2144(%rsp)
	vmovups	%zmm0, 2240(%rsp)
	movq	$0, 2304(%rsp)
	vmovups	%zmm0, 1328(%rsp)
	movq	$0, 1392(%rsp)
	vmovups	%zmm0, 2000(%rsp)
	movq	$0, 2064(%rsp)
	vmovups	%zmm0, 2608(%rsp)
	movq	$0, 2672(%rsp)
	vmovups	%zmm0, 1248(%rsp)
	movq	$0, 1312(%rsp)
	vmovups	%zmm0, 1168(%rsp)
	movq	$0, 1232(%rsp)
	vmovups	%zmm0, 1688(%rsp)
	vmovups	%zmm0, 1592(%rsp)
	vmovups	%ymm1, 1960(%rsp)
	vmovups	%zmm0, 1856(%rsp)
	movq	$0, 1920(%rsp)
	vmovups	%zmm0, 2512(%rsp)
	vmovups	%zmm0, 2160(%rsp)
	movq	$0, 2224(%rsp)
	vmovups	%zmm0, 2416(%rsp)
	vmovups	%zmm0, 2320(%rsp)
	movq	$0, 8(%rsp)
	movq	$0, 24(%rsp)
	testl	%eax, %eax
	je	.LBB1_1
	movabsq	$_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx, %rax
	cmpq	$0, (%rax)
	je	.LBB1_4
	movq	1032(%rsp), %rdi
	movabsq	$PyNumber_Long, %r12
	vzeroupper
	callq	*%r12
	movabsq	$PyLong_AsLongLong, %r14
	movabsq	$Py_DecRef, %r15
	testq	%rax, %rax
	je	.LBB1_7
	movq	%rax, %rdi
	movq	%rax, %rbx
	callq	*%r14
	movq	%rbx, %rdi
	movq	%rax, %rbp
	callq	*%r15
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	jne	.LBB1_1
.LBB1_10:
	movq	1024(%rsp), %rdi
	callq	*%r12
	testq	%rax, %rax
	je	.LBB1_11
	movq	%rax, %rdi
	movq	%rax, %rbx
	callq	*%r14
	movq	%rbx, %rdi
	movq	%rax, %r14
	callq	*%r15
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	jne	.LBB1_1
.LBB1_14:
	movq	1016(%rsp), %rdi
	movabsq	$numba_adapt_ndarray, %rax
	leaq	1488(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 1488(%rsp)
	movq	$0, 1552(%rsp)
	movq	%rax, %r13
	vzeroupper
	callq	*%rax
	cmpq	$8, 1512(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_15
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_17:
	movq	1528(%rsp), %rax
	movq	1536(%rsp), %rdx
	movq	1544(%rsp), %rcx
	movq	1008(%rsp), %rdi
	movq	%rbp, 864(%rsp)
	movq	1488(%rsp), %r15
	movq	1496(%rsp), %r12
	movq	1504(%rsp), %rbp
	movq	1520(%rsp), %rbx
	leaq	1104(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%ymm0, 1104(%rsp)
	vmovups	%ymm0, 1128(%rsp)
	movq	%rax, 856(%rsp)
	movq	1552(%rsp), %rax
	movq	%rdx, 848(%rsp)
	movq	%rcx, 840(%rsp)
	movq	%rax, 832(%rsp)
	vzeroupper
	callq	*%r13
	testl	%eax, %eax
	jne	.LBB1_19
	cmpq	$8, 1128(%rsp)
	jne	.LBB1_19
	movq	1104(%rsp), %rax
	movq	1112(%rsp), %rdx
	movq	1120(%rsp), %rcx
	movq	1000(%rsp), %rdi
	leaq	1760(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 1760(%rsp)
	movq	%rbx, 824(%rsp)
	vmovups	%zmm0, 1784(%rsp)
	movq	%rax, 816(%rsp)
	movq	%rdx, 808(%rsp)
	movq	%rcx, 800(%rsp)
	movq	1136(%rsp), %rdx
	movq	1144(%rsp), %rcx
	movq	1152(%rsp), %rax
	movq	%rdx, 792(%rsp)
	movq	%rcx, 784(%rsp)
	movq	%rax, 776(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 1784(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_21
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_23:
	movq	1776(%rsp), %rcx
	movq	1792(%rsp), %rdx
	movq	1768(%rsp), %rax
	movq	992(%rsp), %rdi
	movq	1760(%rsp), %rbx
	leaq	1040(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%ymm0, 1040(%rsp)
	vmovups	%ymm0, 1064(%rsp)
	movq	%rcx, 760(%rsp)
	movq	1800(%rsp), %rcx
	movq	%rdx, 752(%rsp)
	movq	1808(%rsp), %rdx
	movq	%rax, 768(%rsp)
	movq	1840(%rsp), %rax
	movq	%rcx, 744(%rsp)
	movq	1816(%rsp), %rcx
	movq	%rdx, 736(%rsp)
	movq	1824(%rsp), %rdx
	movq	%rax, 704(%rsp)
	movq	%rcx, 728(%rsp)
	movq	1832(%rsp), %rcx
	movq	%rdx, 720(%rsp)
	movq	%rcx, 712(%rsp)
	vzeroupper
	callq	*%r13
	testl	%eax, %eax
	jne	.LBB1_19
	cmpq	$8, 1064(%rsp)
	jne	.LBB1_19
	movq	1040(%rsp), %rax
	movq	1048(%rsp), %rdx
	movq	1056(%rsp), %rcx
	movq	984(%rsp), %rdi
	leaq	1408(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	movq	%rbx, 696(%rsp)
	vmovups	%zmm0, 1408(%rsp)
	movq	$0, 1472(%rsp)
	movq	%rax, 688(%rsp)
	movq	%rdx, 680(%rsp)
	movq	%rcx, 672(%rsp)
	movq	1072(%rsp), %rdx
	movq	1080(%rsp), %rcx
	movq	1088(%rsp), %rax
	movq	%rdx, 664(%rsp)
	movq	%rcx, 656(%rsp)
	movq	%rax, 648(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 1432(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_26
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_28:
	movq	1416(%rsp), %rdx
	movq	1424(%rsp), %rcx
	movq	1408(%rsp), %rax
	movq	976(%rsp), %rdi
	leaq	2080(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 2080(%rsp)
	movq	$0, 2144(%rsp)
	movq	%rdx, 632(%rsp)
	movq	%rcx, 624(%rsp)
	movq	1440(%rsp), %rdx
	movq	1448(%rsp), %rcx
	movq	%rax, 640(%rsp)
	movq	1472(%rsp), %rax
	movq	%rdx, 616(%rsp)
	movq	%rcx, 608(%rsp)
	movq	1456(%rsp), %rdx
	movq	1464(%rsp), %rcx
	movq	%rax, 584(%rsp)
	movq	%rdx, 600(%rsp)
	movq	%rcx, 592(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 2104(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_29
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_31:
	movq	2112(%rsp), %rax
	movq	2120(%rsp), %rcx
	movq	968(%rsp), %rdi
	leaq	2240(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 2240(%rsp)
	movq	$0, 2304(%rsp)
	movq	%rax, 576(%rsp)
	movq	2128(%rsp), %rax
	movq	%rcx, 568(%rsp)
	movq	%rax, 560(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 2264(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_32
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_34:
	movq	2272(%rsp), %rax
	movq	960(%rsp), %rdi
	leaq	1328(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 1328(%rsp)
	movq	$0, 1392(%rsp)
	movq	%rax, 552(%rsp)
	movq	2288(%rsp), %rax
	movq	%rax, 544(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 1352(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_35
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_37:
	movq	1336(%rsp), %rdx
	movq	1344(%rsp), %rcx
	movq	1328(%rsp), %rax
	movq	952(%rsp), %rdi
	leaq	2000(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 2000(%rsp)
	movq	$0, 2064(%rsp)
	movq	%rdx, 528(%rsp)
	movq	%rcx, 520(%rsp)
	movq	1360(%rsp), %rdx
	movq	1368(%rsp), %rcx
	movq	%rax, 536(%rsp)
	movq	1392(%rsp), %rax
	movq	%rdx, 512(%rsp)
	movq	%rcx, 504(%rsp)
	movq	1376(%rsp), %rdx
	movq	1384(%rsp), %rcx
	movq	%rax, 480(%rsp)
	movq	%rdx, 496(%rsp)
	movq	%rcx, 488(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 2024(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_38
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_40:
	movq	2032(%rsp), %rax
	movq	2040(%rsp), %rcx
	movq	944(%rsp), %rdi
	leaq	2608(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 2608(%rsp)
	movq	$0, 2672(%rsp)
	movq	%rax, 472(%rsp)
	movq	2048(%rsp), %rax
	movq	%rcx, 464(%rsp)
	movq	%rax, 456(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 2632(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_41
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_43:
	movq	2640(%rsp), %rax
	movq	936(%rsp), %rdi
	movq	%rax, 440(%rsp)
	movabsq	$PyNumber_Float, %rax
	callq	*%rax
	movq	%rax, %rbx
	movabsq	$PyFloat_AsDouble, %rax
	movq	%rbx, %rdi
	callq	*%rax
	movabsq	$Py_DecRef, %rax
	movq	%rbx, %rdi
	vmovsd	%xmm0, 448(%rsp)
	callq	*%rax
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	jne	.LBB1_1
	movq	928(%rsp), %rdi
	movabsq	$PyNumber_Long, %rax
	callq	*%rax
	testq	%rax, %rax
	je	.LBB1_45
	movq	%rax, %rbx
	movq	%rax, %rdi
	movabsq	$PyLong_AsLongLong, %rax
	callq	*%rax
	movq	%rax, 16(%rsp)
	movabsq	$Py_DecRef, %rax
	movq	%rbx, %rdi
	callq	*%rax
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	jne	.LBB1_1
.LBB1_48:
	movq	920(%rsp), %rdi
	leaq	1248(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 1248(%rsp)
	movq	$0, 1312(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 1272(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_49
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_51:
	movq	1256(%rsp), %rdx
	movq	1264(%rsp), %rcx
	movq	1248(%rsp), %rax
	movq	912(%rsp), %rdi
	leaq	1168(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 1168(%rsp)
	movq	$0, 1232(%rsp)
	movq	%rdx, 424(%rsp)
	movq	%rcx, 416(%rsp)
	movq	1280(%rsp), %rdx
	movq	1288(%rsp), %rcx
	movq	%rax, 432(%rsp)
	movq	1312(%rsp), %rax
	movq	%rdx, 408(%rsp)
	movq	%rcx, 400(%rsp)
	movq	1296(%rsp), %rdx
	movq	1304(%rsp), %rcx
	movq	%rax, 376(%rsp)
	movq	%rdx, 392(%rsp)
	movq	%rcx, 384(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 1192(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_52
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_54:
	movq	1176(%rsp), %rdx
	movq	1184(%rsp), %rcx
	movq	1168(%rsp), %rax
	movq	904(%rsp), %rdi
	leaq	1664(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 1664(%rsp)
	vmovups	%zmm0, 1688(%rsp)
	movq	%rdx, 360(%rsp)
	movq	%rcx, 352(%rsp)
	movq	1200(%rsp), %rdx
	movq	1208(%rsp), %rcx
	movq	%rax, 368(%rsp)
	movq	1232(%rsp), %rax
	movq	%rdx, 344(%rsp)
	movq	%rcx, 336(%rsp)
	movq	1216(%rsp), %rdx
	movq	1224(%rsp), %rcx
	movq	%rax, 312(%rsp)
	movq	%rdx, 328(%rsp)
	movq	%rcx, 320(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 1688(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_55
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_57:
	movq	1672(%rsp), %rdx
	movq	1680(%rsp), %rcx
	movq	1664(%rsp), %rax
	movq	896(%rsp), %rdi
	leaq	1568(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 1568(%rsp)
	vmovups	%zmm0, 1592(%rsp)
	movq	%rdx, 296(%rsp)
	movq	%rcx, 288(%rsp)
	movq	1696(%rsp), %rdx
	movq	1704(%rsp), %rcx
	movq	%rax, 304(%rsp)
	movq	1744(%rsp), %rax
	movq	%rdx, 280(%rsp)
	movq	%rcx, 272(%rsp)
	movq	1712(%rsp), %rdx
	movq	1720(%rsp), %rcx
	movq	%rax, 232(%rsp)
	movq	%rdx, 264(%rsp)
	movq	%rcx, 256(%rsp)
	movq	1728(%rsp), %rdx
	movq	1736(%rsp), %rcx
	movq	%rdx, 248(%rsp)
	movq	%rcx, 240(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 1592(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bl
	orb	%cl, %bl
	cmpb	$1, %bl
	je	.LBB1_58
	testb	%bl, %bl
	jne	.LBB1_1
.LBB1_60:
	movq	1584(%rsp), %rcx
	movq	1600(%rsp), %rdx
	movq	1576(%rsp), %rax
	movq	888(%rsp), %rdi
	movq	1568(%rsp), %rbx
	leaq	1936(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%ymm0, 1936(%rsp)
	vmovups	%ymm0, 1960(%rsp)
	movq	%rcx, 216(%rsp)
	movq	1608(%rsp), %rcx
	movq	%rdx, 208(%rsp)
	movq	1616(%rsp), %rdx
	movq	%rax, 224(%rsp)
	movq	1648(%rsp), %rax
	movq	%rcx, 200(%rsp)
	movq	1624(%rsp), %rcx
	movq	%rdx, 192(%rsp)
	movq	1632(%rsp), %rdx
	movq	%rax, 160(%rsp)
	movq	%rcx, 184(%rsp)
	movq	1640(%rsp), %rcx
	movq	%rdx, 176(%rsp)
	movq	%rcx, 168(%rsp)
	vzeroupper
	callq	*%r13
	testl	%eax, %eax
	jne	.LBB1_19
	cmpq	$8, 1960(%rsp)
	jne	.LBB1_19
	movq	1968(%rsp), %rax
	movq	%rbp, 128(%rsp)
	movq	880(%rsp), %rbp
	movq	%rbx, 120(%rsp)
	movq	%r15, 144(%rsp)
	movq	%r14, 152(%rsp)
	movq	%rax, 112(%rsp)
	movabsq	$PyTuple_Size, %rax
	movq	%rbp, %rdi
	callq	*%rax
	cmpq	$5, %rax
	setne	%bl
	jne	.LBB1_63
.LBB1_64:
	movabsq	$PyTuple_GetItem, %r15
	movq	%rbp, %rdi
	xorl	%esi, %esi
	callq	*%r15
	leaq	1856(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	movq	%rax, %rdi
	vmovups	%zmm0, 1856(%rsp)
	movq	$0, 1920(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 1880(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%r14b
	orb	%cl, %r14b
	cmpb	$1, %r14b
	je	.LBB1_65
	testb	%r14b, %r14b
	jne	.LBB1_67
.LBB1_68:
	movq	1888(%rsp), %rax
	movq	1896(%rsp), %rdx
	movq	1904(%rsp), %rcx
	movl	$1, %esi
	movq	%rbp, %rdi
	movq	%rax, 104(%rsp)
	movq	%rdx, 96(%rsp)
	movq	%rcx, 88(%rsp)
	callq	*%r15
	leaq	2512(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 2512(%rsp)
	movq	%rax, %rdi
	vmovups	%zmm0, 2536(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 2536(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%r14b
	orb	%cl, %r14b
	cmpb	$1, %r14b
	je	.LBB1_69
	testb	%r14b, %r14b
	jne	.LBB1_71
.LBB1_72:
	movq	2544(%rsp), %rax
	movq	2560(%rsp), %rdx
	movq	2568(%rsp), %rcx
	movl	$2, %esi
	movq	%rbp, %rdi
	movq	%rax, 80(%rsp)
	movq	%rdx, 72(%rsp)
	movq	%rcx, 64(%rsp)
	callq	*%r15
	leaq	2160(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	movq	%rax, %rdi
	vmovups	%zmm0, 2160(%rsp)
	movq	$0, 2224(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 2184(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%r14b
	orb	%cl, %r14b
	cmpb	$1, %r14b
	je	.LBB1_73
	testb	%r14b, %r14b
	jne	.LBB1_75
.LBB1_76:
	movq	2192(%rsp), %rax
	movq	2208(%rsp), %rcx
	movl	$3, %esi
	movq	%rbp, %rdi
	movq	%rax, 56(%rsp)
	movq	%rcx, 48(%rsp)
	callq	*%r15
	leaq	2416(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 2416(%rsp)
	movq	%rax, %rdi
	vmovups	%zmm0, 2440(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 2440(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%r14b
	orb	%cl, %r14b
	cmpb	$1, %r14b
	je	.LBB1_77
	movq	%r12, 136(%rsp)
	testb	%r14b, %r14b
	jne	.LBB1_79
.LBB1_80:
	movq	2472(%rsp), %rax
	movq	2448(%rsp), %r12
	movq	2464(%rsp), %r14
	movl	$4, %esi
	movq	%rbp, %rdi
	movq	%rax, 40(%rsp)
	callq	*%r15
	leaq	2320(%rsp), %rsi
	vxorps	%xmm0, %xmm0, %xmm0
	vmovups	%zmm0, 2320(%rsp)
	movq	%rax, %rdi
	vmovups	%zmm0, 2344(%rsp)
	vzeroupper
	callq	*%r13
	cmpq	$8, 2344(%rsp)
	setne	%cl
	testl	%eax, %eax
	setne	%bpl
	orb	%cl, %bpl
	cmpb	$1, %bpl
	je	.LBB1_81
	orb	%bpl, %bl
	jne	.LBB1_1
.LBB1_83:
	movq	872(%rsp), %rdi
	movq	%r14, 32(%rsp)
	movq	2352(%rsp), %r15
	movq	2368(%rsp), %r14
	movq	2376(%rsp), %r13
	movabsq	$PyNumber_Long, %rax
	callq	*%rax
	testq	%rax, %rax
	je	.LBB1_84
	movq	%rax, %rbp
	movq	%rax, %rdi
	movabsq	$PyLong_AsLongLong, %rax
	callq	*%rax
	movq	%rbp, %rdi
	movabsq	$Py_DecRef, %rbp
	movq	%rax, %rbx
	callq	*%rbp
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	jne	.LBB1_1
.LBB1_87:
	movabsq	$PyEval_SaveThread, %rax
	callq	*%rax
	movq	%rax, %rbp
	movq	$0, 8(%rsp)
	subq	$1488, %rsp
	.cfi_adjust_cfa_offset 1488
	movq	1520(%rsp), %rdx
	movq	1536(%rsp), %rcx
	vmovsd	1936(%rsp), %xmm0
	movq	1528(%rsp), %rax
	movq	1632(%rsp), %r8
	movq	1624(%rsp), %r9
	leaq	1496(%rsp), %rdi
	leaq	1512(%rsp), %rsi
	movq	%rbx, 1480(%rsp)
	movq	%r13, 1448(%rsp)
	movq	%r14, 1440(%rsp)
	movq	%r15, 1424(%rsp)
	movq	%r12, 1336(%rsp)
	movq	$8, 952(%rsp)
	movq	$8, 864(%rsp)
	movq	$8, 792(%rsp)
	movq	$8, 720(%rsp)
	movq	$8, 496(%rsp)
	movq	$8, 280(%rsp)
	movq	$8, 224(%rsp)
	movq	$8, 136(%rsp)
	movq	$8, 80(%rsp)
	movq	$8, 8(%rsp)
	movq	%rdx, 1352(%rsp)
	movq	%rcx, 1280(%rsp)
	movq	1544(%rsp), %rdx
	movq	1552(%rsp), %rcx
	movq	%rax, 1360(%rsp)
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx, %rax
	movq	%rdx, 1264(%rsp)
	movq	%rcx, 1200(%rsp)
	movq	1560(%rsp), %rdx
	movq	1568(%rsp), %rcx
	movq	%rdx, 1192(%rsp)
	movq	%rcx, 1176(%rsp)
	movq	1576(%rsp), %rdx
	movq	1584(%rsp), %rcx
	movq	%rdx, 1120(%rsp)
	movq	%rcx, 1112(%rsp)
	movq	1592(%rsp), %rdx
	movq	1600(%rsp), %rcx
	movq	%rdx, 1104(%rsp)
	movq	%rcx, 1048(%rsp)
	movq	1648(%rsp), %rdx
	movq	1656(%rsp), %rcx
	movq	%rdx, 1008(%rsp)
	movq	%rcx, 1000(%rsp)
	movq	1664(%rsp), %rdx
	movq	1672(%rsp), %rcx
	movq	%rdx, 992(%rsp)
	movq	%rcx, 984(%rsp)
	movq	1680(%rsp), %rdx
	movq	1688(%rsp), %rcx
	movq	%rdx, 976(%rsp)
	movq	%rcx, 968(%rsp)
	movq	1696(%rsp), %rdx
	movq	1704(%rsp), %rcx
	movq	%rdx, 960(%rsp)
	movq	%rcx, 944(%rsp)
	movq	1712(%rsp), %rdx
	movq	1608(%rsp), %rcx
	movq	%rdx, 936(%rsp)
	movq	%rcx, 928(%rsp)
	movq	1720(%rsp), %rdx
	movq	1728(%rsp), %rcx
	movq	%rdx, 920(%rsp)
	movq	%rcx, 912(%rsp)
	movq	1736(%rsp), %rdx
	movq	1744(%rsp), %rcx
	movq	%rdx, 904(%rsp)
	movq	%rcx, 896(%rsp)
	movq	1752(%rsp), %rdx
	movq	1760(%rsp), %rcx
	movq	%rdx, 888(%rsp)
	movq	%rcx, 880(%rsp)
	movq	1768(%rsp), %rdx
	movq	1776(%rsp), %rcx
	movq	%rdx, 872(%rsp)
	movq	%rcx, 856(%rsp)
	movq	1784(%rsp), %rdx
	movq	1792(%rsp), %rcx
	movq	%rdx, 848(%rsp)
	movq	%rcx, 840(%rsp)
	movq	1800(%rsp), %rdx
	movq	1808(%rsp), %rcx
	movq	%rdx, 832(%rsp)
	movq	%rcx, 824(%rsp)
	movq	1816(%rsp), %rdx
	movq	1824(%rsp), %rcx
	movq	%rdx, 816(%rsp)
	movq	%rcx, 808(%rsp)
	movq	1832(%rsp), %rdx
	movq	1840(%rsp), %rcx
	movq	%rdx, 800(%rsp)
	movq	%rcx, 784(%rsp)
	movq	1848(%rsp), %rdx
	movq	1856(%rsp), %rcx
	movq	%rdx, 776(%rsp)
	movq	%rcx, 768(%rsp)
	movq	1864(%rsp), %rdx
	movq	1872(%rsp), %rcx
	movq	%rdx, 760(%rsp)
	movq	%rcx, 752(%rsp)
	movq	1880(%rsp), %rdx
	movq	1888(%rsp), %rcx
	movq	%rdx, 744(%rsp)
	movq	%rcx, 736(%rsp)
	movq	1896(%rsp), %rdx
	movq	1904(%rsp), %rcx
	movq	%rdx, 728(%rsp)
	movq	%rcx, 712(%rsp)
	movq	1912(%rsp), %rdx
	movq	1920(%rsp), %rcx
	movq	%rdx, 704(%rsp)
	movq	%rcx, 696(%rsp)
	movq	1504(%rsp), %rdx
	movq	1928(%rsp), %rcx
	movq	%rdx, 688(%rsp)
	movq	%rcx, 648(%rsp)
	movq	1944(%rsp), %rdx
	movq	1952(%rsp), %rcx
	movq	%rdx, 592(%rsp)
	movq	%rcx, 584(%rsp)
	movq	1960(%rsp), %rdx
	movq	1968(%rsp), %rcx
	movq	%rdx, 576(%rsp)
	movq	%rcx, 536(%rsp)
	movq	1976(%rsp), %rdx
	movq	1984(%rsp), %rcx
	movq	%rdx, 528(%rsp)
	movq	%rcx, 520(%rsp)
	movq	1992(%rsp), %rdx
	movq	2000(%rsp), %rcx
	movq	%rdx, 512(%rsp)
	movq	%rcx, 504(%rsp)
	movq	2008(%rsp), %rdx
	movq	2016(%rsp), %rcx
	movq	%rdx, 488(%rsp)
	movq	%rcx, 480(%rsp)
	movq	2024(%rsp), %rdx
	movq	2032(%rsp), %rcx
	movq	%rdx, 472(%rsp)
	movq	%rcx, 448(%rsp)
	movq	2040(%rsp), %rdx
	movq	2048(%rsp), %rcx
	movq	%rdx, 432(%rsp)
	movq	%rcx, 376(%rsp)
	movq	2056(%rsp), %rdx
	movq	2064(%rsp), %rcx
	movq	%rdx, 368(%rsp)
	movq	%rcx, 360(%rsp)
	movq	2072(%rsp), %rdx
	movq	2080(%rsp), %rcx
	movq	%rdx, 320(%rsp)
	movq	%rcx, 312(%rsp)
	movq	2088(%rsp), %rdx
	movq	2096(%rsp), %rcx
	movq	%rdx, 304(%rsp)
	movq	%rcx, 296(%rsp)
	movq	2104(%rsp), %rdx
	movq	2112(%rsp), %rcx
	movq	%rdx, 288(%rsp)
	movq	%rcx, 272(%rsp)
	movq	2120(%rsp), %rdx
	movq	2128(%rsp), %rcx
	movq	%rdx, 264(%rsp)
	movq	%rcx, 256(%rsp)
	movq	2136(%rsp), %rdx
	movq	2144(%rsp), %rcx
	movq	%rdx, 248(%rsp)
	movq	%rcx, 240(%rsp)
	movq	2152(%rsp), %rdx
	movq	2160(%rsp), %rcx
	movq	%rdx, 232(%rsp)
	movq	%rcx, 216(%rsp)
	movq	2168(%rsp), %rdx
	movq	2176(%rsp), %rcx
	movq	%rdx, 208(%rsp)
	movq	%rcx, 200(%rsp)
	movq	2192(%rsp), %rdx
	movq	2200(%rsp), %rcx
	movq	%rdx, 192(%rsp)
	movq	%rcx, 184(%rsp)
	movq	2208(%rsp), %rdx
	movq	2216(%rsp), %rcx
	movq	%rdx, 176(%rsp)
	movq	%rcx, 168(%rsp)
	movq	2224(%rsp), %rdx
	movq	2232(%rsp), %rcx
	movq	%rdx, 160(%rsp)
	movq	%rcx, 152(%rsp)
	movq	2240(%rsp), %rdx
	movq	2248(%rsp), %rcx
	movq	%rdx, 144(%rsp)
	movq	%rcx, 128(%rsp)
	movq	2256(%rsp), %rdx
	movq	2184(%rsp), %rcx
	movq	%rdx, 120(%rsp)
	movq	%rcx, 112(%rsp)
	movq	2264(%rsp), %rdx
	movq	2272(%rsp), %rcx
	movq	%rdx, 104(%rsp)
	movq	%rcx, 96(%rsp)
	movq	2280(%rsp), %rdx
	movq	2288(%rsp), %rcx
	movq	%rdx, 88(%rsp)
	movq	%rcx, 72(%rsp)
	movq	2296(%rsp), %rdx
	movq	2304(%rsp), %rcx
	movq	%rdx, 64(%rsp)
	movq	%rcx, 56(%rsp)
	movq	2320(%rsp), %rdx
	movq	2328(%rsp), %rcx
	movq	%rdx, 48(%rsp)
	movq	%rcx, 40(%rsp)
	movq	2336(%rsp), %rdx
	movq	2344(%rsp), %rcx
	movq	%rdx, 32(%rsp)
	movq	%rcx, 24(%rsp)
	movq	2312(%rsp), %rdx
	movq	1616(%rsp), %rcx
	movq	%rdx, 16(%rsp)
	movq	%rcx, (%rsp)
	movq	2352(%rsp), %rdx
	movq	1640(%rsp), %rcx
	callq	*%rax
	addq	$1488, %rsp
	.cfi_adjust_cfa_offset -1488
	movq	24(%rsp), %r15
	movq	8(%rsp), %r14
	movl	%eax, %ebx
	movabsq	$PyEval_RestoreThread, %rax
	movq	%rbp, %rdi
	callq	*%rax
	testl	%ebx, %ebx
	jne	.LBB1_88
	movabsq	$PyLong_FromLongLong, %rax
	movq	%r14, %rdi
	callq	*%rax
	jmp	.LBB1_2
.LBB1_19:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	jmp	.LBB1_5
.LBB1_88:
	jle	.LBB1_92
	movabsq	$PyErr_Clear, %rax
	callq	*%rax
	movl	8(%r15), %esi
	movq	(%r15), %rdi
	cmpl	$0, 32(%r15)
	jle	.LBB1_95
	movslq	%esi, %rsi
	movabsq	$PyBytes_FromStringAndSize, %rax
	callq	*%rax
	movq	16(%r15), %rdi
	movq	%rax, %rbx
	callq	*24(%r15)
	testq	%rax, %rax
	je	.LBB1_91
	movabsq	$numba_runtime_build_excinfo_struct, %rcx
	movq	%rbx, %rdi
	movq	%rax, %rsi
	callq	*%rcx
	jmp	.LBB1_96
.LBB1_4:
	movabsq	$PyExc_RuntimeError, %rdi
	movabsq	$".const.missing Environment: _ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx", %rsi
.LBB1_5:
	movabsq	$PyErr_SetString, %rax
	vzeroupper
	callq	*%rax
	jmp	.LBB1_1
.LBB1_7:
	xorl	%ebp, %ebp
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	je	.LBB1_10
	jmp	.LBB1_1
.LBB1_11:
	xorl	%r14d, %r14d
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	je	.LBB1_14
	jmp	.LBB1_1
.LBB1_15:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_17
	jmp	.LBB1_1
.LBB1_21:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_23
	jmp	.LBB1_1
.LBB1_26:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_28
	jmp	.LBB1_1
.LBB1_29:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_31
	jmp	.LBB1_1
.LBB1_32:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_34
	jmp	.LBB1_1
.LBB1_35:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_37
	jmp	.LBB1_1
.LBB1_38:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_40
	jmp	.LBB1_1
.LBB1_41:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_43
	jmp	.LBB1_1
.LBB1_45:
	movq	$0, 16(%rsp)
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	je	.LBB1_48
	jmp	.LBB1_1
.LBB1_49:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_51
	jmp	.LBB1_1
.LBB1_52:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_54
	jmp	.LBB1_1
.LBB1_55:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_57
	jmp	.LBB1_1
.LBB1_58:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%bl, %bl
	je	.LBB1_60
	jmp	.LBB1_1
.LBB1_63:
	movabsq	$PyExc_ValueError, %rdi
	movabsq	$".const.size mismatch for tuple, expected 5 element(s) but got %zd", %rsi
	movabsq	$PyErr_Format, %rcx
	movq	%rax, %rdx
	xorl	%eax, %eax
	callq	*%rcx
	jmp	.LBB1_64
.LBB1_65:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%r14b, %r14b
	je	.LBB1_68
.LBB1_67:
	movb	$1, %bl
	jmp	.LBB1_68
.LBB1_69:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%r14b, %r14b
	je	.LBB1_72
.LBB1_71:
	movb	$1, %bl
	jmp	.LBB1_72
.LBB1_73:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	testb	%r14b, %r14b
	je	.LBB1_76
.LBB1_75:
	movb	$1, %bl
	jmp	.LBB1_76
.LBB1_77:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	movq	%r12, 136(%rsp)
	testb	%r14b, %r14b
	je	.LBB1_80
.LBB1_79:
	movb	$1, %bl
	jmp	.LBB1_80
.LBB1_81:
	movabsq	$PyExc_TypeError, %rdi
	movabsq	$".const.can't unbox array from PyObject into native value.  The object maybe of a different type", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	orb	%bpl, %bl
	je	.LBB1_83
	jmp	.LBB1_1
.LBB1_84:
	xorl	%ebx, %ebx
	movabsq	$PyErr_Occurred, %rax
	callq	*%rax
	testq	%rax, %rax
	je	.LBB1_87
	jmp	.LBB1_1
.LBB1_92:
	cmpl	$-3, %ebx
	je	.LBB1_98
	cmpl	$-1, %ebx
	je	.LBB1_1
	movabsq	$PyExc_SystemError, %rdi
	movabsq	$".const.unknown error when calling native function", %rsi
	jmp	.LBB1_5
.LBB1_95:
	movq	16(%r15), %rdx
	movabsq	$numba_unpickle, %rax
	callq	*%rax
.LBB1_96:
	testq	%rax, %rax
	je	.LBB1_1
	movabsq	$numba_do_raise, %rcx
	movq	%rax, %rdi
	callq	*%rcx
.LBB1_1:
	xorl	%eax, %eax
.LBB1_2:
	addq	$2680, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.LBB1_98:
	.cfi_def_cfa_offset 2736
	movabsq	$PyExc_StopIteration, %rdi
	movabsq	$PyErr_SetNone, %rax
	callq	*%rax
	jmp	.LBB1_1
.LBB1_91:
	movabsq	$PyExc_RuntimeError, %rdi
	movabsq	$".const.Error creating Python tuple from runtime exception arguments", %rsi
	jmp	.LBB1_5
.Lfunc_end1:
	.size	_ZN7cpython42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx, .Lfunc_end1-_ZN7cpython42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx
	.cfi_endproc

	.globl	cfunc._ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx
	.p2align	4
	.type	cfunc._ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx,@function
cfunc._ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$1544, %rsp
	.cfi_def_cfa_offset 1600
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	vmovaps	3024(%rsp), %xmm22
	movq	%rcx, 1520(%rsp)
	movq	3064(%rsp), %rax
	movq	3008(%rsp), %rcx
	vmovaps	2160(%rsp), %xmm11
	vmovups	2272(%rsp), %zmm12
	vmovaps	2336(%rsp), %xmm13
	vmovups	2352(%rsp), %zmm14
	vmovups	2424(%rsp), %zmm15
	vmovups	2488(%rsp), %xmm16
	vmovups	2512(%rsp), %zmm17
	vmovaps	2576(%rsp), %xmm18
	vmovaps	2688(%rsp), %xmm19
	vmovups	2776(%rsp), %xmm20
	vmovups	2936(%rsp), %xmm21
	movq	%r9, %rbp
	movq	%r8, %r13
	movq	%rdx, 1512(%rsp)
	movq	%rsi, 1536(%rsp)
	movq	%rdi, 1528(%rsp)
	movq	$0, 1504(%rsp)
	movq	$0, 1496(%rsp)
	movq	2176(%rsp), %r12
	movq	2232(%rsp), %r15
	movq	2416(%rsp), %r14
	movq	2504(%rsp), %rbx
	movq	2592(%rsp), %r11
	movq	2632(%rsp), %r10
	movq	2704(%rsp), %r9
	movq	2760(%rsp), %r8
	movq	2848(%rsp), %rdi
	movq	2864(%rsp), %rsi
	movq	2920(%rsp), %rdx
	vmovups	2056(%rsp), %zmm10
	vmovups	1944(%rsp), %xmm9
	vmovups	1784(%rsp), %ymm6
	vmovups	1816(%rsp), %xmm7
	vmovups	1840(%rsp), %zmm8
	vmovups	1600(%rsp), %ymm1
	vmovups	1640(%rsp), %ymm2
	vmovups	1672(%rsp), %xmm3
	vmovups	1696(%rsp), %zmm4
	vmovaps	1760(%rsp), %xmm5
	movq	%rax, 1480(%rsp)
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx, %rax
	vmovups	%xmm22, 1440(%rsp)
	movq	%rcx, 1424(%rsp)
	movq	2120(%rsp), %rcx
	vmovups	%xmm21, 1352(%rsp)
	movq	%rdx, 1336(%rsp)
	movq	%rsi, 1280(%rsp)
	movq	%rdi, 1264(%rsp)
	vmovups	%xmm20, 1192(%rsp)
	movq	%r8, 1176(%rsp)
	movq	%r9, 1120(%rsp)
	vmovups	%xmm19, 1104(%rsp)
	movq	%r10, 1048(%rsp)
	movq	%r11, 1008(%rsp)
	vmovups	%xmm18, 992(%rsp)
	vmovups	%zmm17, 928(%rsp)
	movq	%rbx, 920(%rsp)
	vmovups	%xmm16, 904(%rsp)
	vmovups	%zmm15, 840(%rsp)
	movq	%r14, 832(%rsp)
	vmovups	%zmm14, 768(%rsp)
	vmovups	%xmm13, 752(%rsp)
	vmovups	%zmm12, 688(%rsp)
	movq	%r15, 648(%rsp)
	movq	%r12, 592(%rsp)
	vmovups	%xmm11, 576(%rsp)
	movq	2032(%rsp), %rdx
	leaq	1504(%rsp), %rdi
	leaq	1496(%rsp), %rsi
	movq	%rcx, 536(%rsp)
	movq	2016(%rsp), %rcx
	vmovups	%zmm10, 472(%rsp)
	movq	%rdx, 448(%rsp)
	movq	1960(%rsp), %rdx
	movq	%rcx, 432(%rsp)
	movq	1904(%rsp), %rcx
	movq	%rdx, 376(%rsp)
	vmovups	%xmm9, 360(%rsp)
	movq	1832(%rsp), %rdx
	movq	%rcx, 320(%rsp)
	movq	1776(%rsp), %rcx
	vmovups	%zmm8, 256(%rsp)
	movq	%rdx, 248(%rsp)
	vmovups	%xmm7, 232(%rsp)
	vmovups	%ymm6, 200(%rsp)
	movq	1688(%rsp), %rdx
	movq	%rcx, 192(%rsp)
	movq	1632(%rsp), %rcx
	vmovups	%xmm5, 176(%rsp)
	vmovups	%zmm4, 112(%rsp)
	movq	%rdx, 104(%rsp)
	vmovups	%xmm3, 88(%rsp)
	vmovups	%ymm2, 56(%rsp)
	movq	%rcx, 48(%rsp)
	vmovups	%ymm1, 16(%rsp)
	movq	%rbp, 8(%rsp)
	movq	%r13, (%rsp)
	movq	1512(%rsp), %r8
	movq	1520(%rsp), %r9
	movq	1528(%rsp), %rdx
	movq	1536(%rsp), %rcx
	vzeroupper
	callq	*%rax
	movl	%eax, %ecx
	movq	1496(%rsp), %r15
	movq	1504(%rsp), %rax
	movl	$0, 1492(%rsp)
	testl	%ecx, %ecx
	jne	.LBB2_1
.LBB2_7:
	addq	$1544, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	retq
.LBB2_1:
	.cfi_def_cfa_offset 1600
	movabsq	$numba_gil_ensure, %r12
	leaq	1492(%rsp), %rdi
	movq	%rax, %r14
	movl	%ecx, %ebx
	callq	*%r12
	testl	%ebx, %ebx
	jle	.LBB2_8
	movabsq	$PyErr_Clear, %rax
	callq	*%rax
	movl	8(%r15), %esi
	movq	(%r15), %rdi
	cmpl	$0, 32(%r15)
	jle	.LBB2_11
	movslq	%esi, %rsi
	movabsq	$PyBytes_FromStringAndSize, %rax
	callq	*%rax
	movq	16(%r15), %rdi
	movq	%rax, %rbx
	callq	*24(%r15)
	testq	%rax, %rax
	je	.LBB2_4
	movabsq	$numba_runtime_build_excinfo_struct, %rcx
	movq	%rbx, %rdi
	movq	%rax, %rsi
	callq	*%rcx
	jmp	.LBB2_12
.LBB2_8:
	movl	%ebx, %eax
	cmpl	$-3, %ebx
	je	.LBB2_5
	cmpl	$-1, %eax
	je	.LBB2_6
	movabsq	$PyExc_SystemError, %rdi
	movabsq	$".const.unknown error when calling native function.2", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	jmp	.LBB2_6
.LBB2_11:
	movq	16(%r15), %rdx
	movabsq	$numba_unpickle, %rax
	callq	*%rax
.LBB2_12:
	testq	%rax, %rax
	je	.LBB2_6
	movabsq	$numba_do_raise, %rcx
	movq	%rax, %rdi
	callq	*%rcx
.LBB2_6:
	movabsq	$".const.<numba.core.cpu.CPUContext>", %rdi
	movabsq	$PyUnicode_FromString, %rax
	callq	*%rax
	movabsq	$PyErr_WriteUnraisable, %r15
	movq	%rax, %rbx
	movq	%rbx, %rdi
	callq	*%r15
	movabsq	$Py_DecRef, %rax
	movq	%rbx, %rdi
	callq	*%rax
	movabsq	$numba_gil_release, %rax
	leaq	1492(%rsp), %rdi
	callq	*%rax
	movq	%r14, %rax
	jmp	.LBB2_7
.LBB2_5:
	movabsq	$PyExc_StopIteration, %rdi
	movabsq	$PyErr_SetNone, %rax
	callq	*%rax
	jmp	.LBB2_6
.LBB2_4:
	movabsq	$PyExc_RuntimeError, %rdi
	movabsq	$".const.Error creating Python tuple from runtime exception arguments.1", %rsi
	movabsq	$PyErr_SetString, %rax
	callq	*%rax
	xorl	%eax, %eax
	jmp	.LBB2_7
.Lfunc_end2:
	.size	cfunc._ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx, .Lfunc_end2-cfunc._ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx
	.cfi_endproc

	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx:
	pushq	%rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	movq	376(%rsp), %r14
	movq	208(%rsp), %rbp
	movq	128(%rsp), %rax
	movq	56(%rsp), %r12
	movq	%rdi, %r9
	testq	%rbp, %rbp
	jle	.LBB3_1
	movq	368(%rsp), %rcx
	movq	200(%rsp), %rsi
	movq	184(%rsp), %rdx
	movq	192(%rsp), %rdi
	leaq	7(%r14), %r13
	xorl	%r11d, %r11d
	shrq	$3, %r13
	movq	%rcx, %r8
	sarq	$63, %r8
	andq	%rsi, %r8
	addq	%rcx, %r8
	imulq	%rbp, %r8
	testq	%r14, %r14
	cmovgq	%r13, %r11
	leaq	(%rdx,%r8,8), %r8
	cmpq	$1, %rdi
	jne	.LBB3_45
	testq	%r11, %r11
	je	.LBB3_2
	movl	%r11d, %r10d
	andl	$7, %r10d
	cmpq	$8, %r11
	jae	.LBB3_8
	movl	%ebp, %r11d
	andl	$7, %r11d
	cmpq	$8, %rbp
	jae	.LBB3_13
	xorl	%ebx, %ebx
	jmp	.LBB3_32
.LBB3_1:
	leaq	7(%r14), %r13
	shrq	$3, %r13
	jmp	.LBB3_2
.LBB3_45:
	testq	%r14, %r14
	jle	.LBB3_63
	movq	72(%rsp), %r11
	movabsq	$9223372036854775800, %rcx
	movq	272(%rsp), %r10
	movq	64(%rsp), %rbx
	imulq	%rbp, %rsi
	movl	%r14d, %r12d
	andl	$3, %r12d
	movq	%r13, -32(%rsp)
	movq	%r9, -24(%rsp)
	xorl	%r13d, %r13d
	orq	$4, %rcx
	andq	%r14, %rcx
	movq	%rcx, -16(%rsp)
	movabsq	$9223372036854775804, %rcx
	andq	%r14, %rcx
	shlq	$3, %r11
	movq	%rcx, -8(%rsp)
	jmp	.LBB3_47
	.p2align	4
.LBB3_54:
	movq	208(%rsp), %rcx
	movq	376(%rsp), %r14
	movq	272(%rsp), %r10
	incq	%r13
	cmpq	%r13, %rcx
	je	.LBB3_55
.LBB3_47:
	leaq	(%r8,%r13,8), %rdx
	movq	%r13, %rbp
	negq	%rbp
	cmpq	$4, %r14
	jae	.LBB3_49
	xorl	%ecx, %ecx
	jmp	.LBB3_52
	.p2align	4
.LBB3_49:
	movq	56(%rsp), %r14
	xorl	%r9d, %r9d
	.p2align	4
.LBB3_50:
	movq	(%r10,%r9,8), %rcx
	movq	%rcx, %r15
	sarq	$63, %r15
	andq	%rdi, %r15
	addq	%rcx, %r15
	movq	24(%rax), %rcx
	imulq	%rsi, %r15
	vmovsd	(%rdx,%r15,8), %xmm1
	movl	$0, %r15d
	cmpq	%rbp, %rcx
	cmovlq	%rbx, %r15
	addq	%r13, %rcx
	addq	%r15, %rcx
	imulq	%r11, %rcx
	addq	%r14, %rcx
	vmovsd	%xmm1, (%rcx,%r9,8)
	movq	8(%r10,%r9,8), %rcx
	movq	%rcx, %r15
	sarq	$63, %r15
	andq	%rdi, %r15
	addq	%rcx, %r15
	movq	24(%rax), %rcx
	imulq	%rsi, %r15
	vmovsd	(%rdx,%r15,8), %xmm1
	movl	$0, %r15d
	cmpq	%rbp, %rcx
	cmovlq	%rbx, %r15
	addq	%r13, %rcx
	addq	%r15, %rcx
	imulq	%r11, %rcx
	addq	%r14, %rcx
	vmovsd	%xmm1, 8(%rcx,%r9,8)
	movq	16(%r10,%r9,8), %rcx
	movq	%rcx, %r15
	sarq	$63, %r15
	andq	%rdi, %r15
	addq	%rcx, %r15
	movq	24(%rax), %rcx
	imulq	%rsi, %r15
	vmovsd	(%rdx,%r15,8), %xmm1
	movl	$0, %r15d
	cmpq	%rbp, %rcx
	cmovlq	%rbx, %r15
	addq	%r13, %rcx
	addq	%r15, %rcx
	imulq	%r11, %rcx
	addq	%r14, %rcx
	vmovsd	%xmm1, 16(%rcx,%r9,8)
	movq	24(%r10,%r9,8), %rcx
	movq	%rcx, %r15
	sarq	$63, %r15
	andq	%rdi, %r15
	addq	%rcx, %r15
	movq	24(%rax), %rcx
	imulq	%rsi, %r15
	vmovsd	(%rdx,%r15,8), %xmm1
	movl	$0, %r15d
	cmpq	%rbp, %rcx
	cmovlq	%rbx, %r15
	addq	%r13, %rcx
	addq	%r15, %rcx
	imulq	%r11, %rcx
	addq	%r14, %rcx
	vmovsd	%xmm1, 24(%rcx,%r9,8)
	addq	$4, %r9
	cmpq	%r9, -8(%rsp)
	jne	.LBB3_50
	movq	-16(%rsp), %rcx
	testq	%r12, %r12
	je	.LBB3_54
.LBB3_52:
	movq	56(%rsp), %r9
	movq	272(%rsp), %r10
	leaq	(%r9,%rcx,8), %r9
	leaq	(%r10,%rcx,8), %r15
	xorl	%ecx, %ecx
	.p2align	4
.LBB3_53:
	movq	(%r15,%rcx,8), %r14
	movq	%r12, %r10
	movq	%r14, %r12
	sarq	$63, %r12
	andq	%rdi, %r12
	addq	%r14, %r12
	movq	24(%rax), %r14
	imulq	%rsi, %r12
	vmovsd	(%rdx,%r12,8), %xmm1
	movl	$0, %r12d
	cmpq	%rbp, %r14
	cmovlq	%rbx, %r12
	addq	%r13, %r14
	addq	%r12, %r14
	movq	%r10, %r12
	imulq	%r11, %r14
	addq	%r9, %r14
	vmovsd	%xmm1, (%r14,%rcx,8)
	incq	%rcx
	cmpq	%rcx, %r10
	jne	.LBB3_53
	jmp	.LBB3_54
.LBB3_55:
	movq	-24(%rsp), %r9
	movq	56(%rsp), %r12
	movq	-32(%rsp), %r13
	jmp	.LBB3_2
.LBB3_8:
	addq	$-8, %r11
	movq	%r14, %rdi
	xorl	%r15d, %r15d
	shrq	$3, %r11
	leaq	1(%r11), %rbx
	movq	%rbx, %r14
	andq	$-2, %r14
	jmp	.LBB3_9
	.p2align	4
.LBB3_43:
	incq	%r15
	addq	$256, %r12
	cmpq	%r15, %rbp
	je	.LBB3_44
.LBB3_9:
	testq	%r11, %r11
	je	.LBB3_10
	movq	%r14, %rdx
	xorl	%esi, %esi
	.p2align	4
.LBB3_37:
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, (%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 64(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 128(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 192(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 256(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 320(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 384(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 448(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 512(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 576(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 640(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 704(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 768(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 832(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 896(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 960(%rcx,%rsi,8)
	subq	$-128, %rsi
	addq	$-2, %rdx
	jne	.LBB3_37
	testb	$1, %bl
	jne	.LBB3_39
	testq	%r10, %r10
	jne	.LBB3_41
	jmp	.LBB3_43
	.p2align	4
.LBB3_10:
	xorl	%esi, %esi
.LBB3_39:
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, (%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 64(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 128(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 192(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 256(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 320(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovups	%zmm1, 384(%rcx,%rsi,8)
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 448(%rcx,%rsi,8)
	addq	$64, %rsi
	testq	%r10, %r10
	je	.LBB3_43
.LBB3_41:
	movq	56(%rsp), %rcx
	movq	%r10, %rdx
	leaq	(%rcx,%rsi,8), %rcx
	.p2align	4
.LBB3_42:
	vbroadcastsd	(%r8,%r15,8), %zmm1
	movq	24(%rax), %rsi
	addq	%r15, %rsi
	shlq	$8, %rsi
	vmovupd	%zmm1, (%rcx,%rsi)
	addq	$64, %rcx
	decq	%rdx
	jne	.LBB3_42
	jmp	.LBB3_43
.LBB3_44:
	movq	56(%rsp), %r12
	movq	%rdi, %r14
	jmp	.LBB3_2
.LBB3_13:
	movabsq	$9223372036854775800, %rcx
	movq	%r13, -32(%rsp)
	movl	$1, %r14d
	movl	$2, %r15d
	movl	$3, %r12d
	movl	$4, %r13d
	movl	$6, %esi
	movl	$7, %edi
	movq	%r11, -16(%rsp)
	movq	%r9, -24(%rsp)
	xorl	%ebx, %ebx
	andq	%rcx, %rbp
	movq	%rbp, -8(%rsp)
	movl	$5, %ebp
	.p2align	4
.LBB3_14:
	movq	56(%rsp), %rdx
	movq	%r10, %rcx
	.p2align	4
.LBB3_15:
	vbroadcastsd	(%r8,%rbx,8), %zmm1
	movq	24(%rax), %r9
	addq	%rbx, %r9
	shlq	$8, %r9
	vmovupd	%zmm1, (%rdx,%r9)
	addq	$64, %rdx
	decq	%rcx
	jne	.LBB3_15
	movq	56(%rsp), %r9
	movq	%rbx, %rcx
	orq	$1, %rcx
	movq	%r10, %rdx
	.p2align	4
.LBB3_17:
	vbroadcastsd	(%r8,%rcx,8), %zmm1
	movq	24(%rax), %r11
	addq	%r14, %r11
	shlq	$8, %r11
	vmovupd	%zmm1, (%r9,%r11)
	addq	$64, %r9
	decq	%rdx
	jne	.LBB3_17
	movq	56(%rsp), %r9
	movq	%rbx, %rcx
	orq	$2, %rcx
	movq	%r10, %rdx
	.p2align	4
.LBB3_19:
	vbroadcastsd	(%r8,%rcx,8), %zmm1
	movq	24(%rax), %r11
	addq	%r15, %r11
	shlq	$8, %r11
	vmovupd	%zmm1, (%r9,%r11)
	addq	$64, %r9
	decq	%rdx
	jne	.LBB3_19
	movq	56(%rsp), %r9
	movq	%rbx, %rcx
	orq	$3, %rcx
	movq	%r10, %rdx
	.p2align	4
.LBB3_21:
	vbroadcastsd	(%r8,%rcx,8), %zmm1
	movq	24(%rax), %r11
	addq	%r12, %r11
	shlq	$8, %r11
	vmovupd	%zmm1, (%r9,%r11)
	addq	$64, %r9
	decq	%rdx
	jne	.LBB3_21
	movq	56(%rsp), %r9
	movq	%rbx, %rcx
	orq	$4, %rcx
	movq	%r10, %rdx
	.p2align	4
.LBB3_23:
	vbroadcastsd	(%r8,%rcx,8), %zmm1
	movq	24(%rax), %r11
	addq	%r13, %r11
	shlq	$8, %r11
	vmovupd	%zmm1, (%r9,%r11)
	addq	$64, %r9
	decq	%rdx
	jne	.LBB3_23
	movq	56(%rsp), %r9
	movq	%rbx, %rcx
	orq	$5, %rcx
	movq	%r10, %rdx
	.p2align	4
.LBB3_25:
	vbroadcastsd	(%r8,%rcx,8), %zmm1
	movq	24(%rax), %r11
	addq	%rbp, %r11
	shlq	$8, %r11
	vmovupd	%zmm1, (%r9,%r11)
	addq	$64, %r9
	decq	%rdx
	jne	.LBB3_25
	movq	56(%rsp), %r9
	movq	%rbx, %rcx
	orq	$6, %rcx
	movq	%r10, %rdx
	.p2align	4
.LBB3_27:
	vbroadcastsd	(%r8,%rcx,8), %zmm1
	movq	24(%rax), %r11
	addq	%rsi, %r11
	shlq	$8, %r11
	vmovupd	%zmm1, (%r9,%r11)
	addq	$64, %r9
	decq	%rdx
	jne	.LBB3_27
	movq	56(%rsp), %r9
	movq	%rbx, %rcx
	orq	$7, %rcx
	movq	%r10, %rdx
	.p2align	4
.LBB3_29:
	vbroadcastsd	(%r8,%rcx,8), %zmm1
	movq	24(%rax), %r11
	addq	%rdi, %r11
	shlq	$8, %r11
	vmovupd	%zmm1, (%r9,%r11)
	addq	$64, %r9
	decq	%rdx
	jne	.LBB3_29
	addq	$8, %rbx
	addq	$8, %r14
	addq	$8, %r15
	addq	$8, %r12
	addq	$8, %r13
	addq	$8, %rbp
	addq	$8, %rsi
	addq	$8, %rdi
	cmpq	-8(%rsp), %rbx
	jne	.LBB3_14
	movq	-16(%rsp), %r11
	movq	-24(%rsp), %r9
	movq	56(%rsp), %r12
	movq	-32(%rsp), %r13
	movq	376(%rsp), %r14
	testq	%r11, %r11
	je	.LBB3_2
.LBB3_32:
	xorl	%edx, %edx
	.p2align	4
.LBB3_33:
	movq	%r10, %rcx
	movq	%r12, %rsi
	.p2align	4
.LBB3_34:
	vbroadcastsd	(%r8,%rbx,8), %zmm1
	movq	24(%rax), %rdi
	addq	%rbx, %rdi
	shlq	$8, %rdi
	vmovupd	%zmm1, (%rsi,%rdi)
	addq	$64, %rsi
	decq	%rcx
	jne	.LBB3_34
	incq	%rbx
	incq	%rdx
	cmpq	%r11, %rdx
	jne	.LBB3_33
.LBB3_2:
	testq	%r14, %r14
	setle	%cl
	testq	%r13, %r13
	sete	%dl
	orb	%cl, %dl
	jne	.LBB3_63
	movq	328(%rsp), %r8
	vbroadcastsd	%xmm0, %zmm0
	movl	%r13d, %esi
	leaq	-1(%r13), %rcx
	andl	$7, %esi
	cmpq	$7, %rcx
	jae	.LBB3_64
	xorl	%edi, %edi
	jmp	.LBB3_61
.LBB3_64:
	addq	$-8, %r13
	shrq	$3, %r13
	je	.LBB3_65
	incq	%r13
	xorl	%edi, %edi
	movq	%r13, %rdx
	andq	$-2, %rdx
	.p2align	4
.LBB3_57:
	vaddpd	(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, (%rcx,%rdi,8)
	vaddpd	64(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 64(%rcx,%rdi,8)
	vaddpd	128(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 128(%rcx,%rdi,8)
	vaddpd	192(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 192(%rcx,%rdi,8)
	vaddpd	256(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 256(%rcx,%rdi,8)
	vaddpd	320(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 320(%rcx,%rdi,8)
	vaddpd	384(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 384(%rcx,%rdi,8)
	vaddpd	448(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 448(%rcx,%rdi,8)
	vaddpd	512(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 512(%rcx,%rdi,8)
	vaddpd	576(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 576(%rcx,%rdi,8)
	vaddpd	640(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 640(%rcx,%rdi,8)
	vaddpd	704(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 704(%rcx,%rdi,8)
	vaddpd	768(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 768(%rcx,%rdi,8)
	vaddpd	832(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 832(%rcx,%rdi,8)
	vaddpd	896(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 896(%rcx,%rdi,8)
	vaddpd	960(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	addq	$-2, %rdx
	vmovupd	%zmm1, 960(%rcx,%rdi,8)
	leaq	128(%rdi), %rdi
	jne	.LBB3_57
	testb	$1, %r13b
	jne	.LBB3_59
	testq	%rsi, %rsi
	jne	.LBB3_61
	jmp	.LBB3_63
.LBB3_65:
	xorl	%edi, %edi
.LBB3_59:
	vaddpd	(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, (%rcx,%rdi,8)
	vaddpd	64(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 64(%rcx,%rdi,8)
	vaddpd	128(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 128(%rcx,%rdi,8)
	vaddpd	192(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 192(%rcx,%rdi,8)
	vaddpd	256(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 256(%rcx,%rdi,8)
	vaddpd	320(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 320(%rcx,%rdi,8)
	vaddpd	384(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 384(%rcx,%rdi,8)
	vaddpd	448(%r8,%rdi,8), %zmm0, %zmm1
	movq	(%rax), %rcx
	shlq	$8, %rcx
	addq	%r12, %rcx
	vmovupd	%zmm1, 448(%rcx,%rdi,8)
	addq	$64, %rdi
	testq	%rsi, %rsi
	je	.LBB3_63
.LBB3_61:
	leaq	(%r12,%rdi,8), %rcx
	leaq	(%r8,%rdi,8), %rdx
	shll	$6, %esi
	xorl	%edi, %edi
	.p2align	4
.LBB3_62:
	vaddpd	(%rdx,%rdi), %zmm0, %zmm1
	movq	(%rax), %r8
	shlq	$8, %r8
	addq	%rcx, %r8
	vmovupd	%zmm1, (%rdi,%r8)
	addq	$64, %rdi
	cmpq	%rdi, %rsi
	jne	.LBB3_62
.LBB3_63:
	movq	$0, (%r9)
	xorl	%eax, %eax
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.Lfunc_end3:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx, .Lfunc_end3-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI4_0:
	.quad	0x4008000000000000
.LCPI4_1:
	.quad	0x7fffffffffffffff
.LCPI4_2:
	.quad	0x3ff0000000000000
.LCPI4_3:
	.quad	0x3d06849b86a12b9b
.LCPI4_4:
	.quad	0x3fe0000000000000
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10linearisedB3v21B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10linearisedB3v21B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10linearisedB3v21B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$152, %rsp
	.cfi_def_cfa_offset 208
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	400(%rsp), %rax
	movq	296(%rsp), %r13
	movq	$0, 144(%rsp)
	movq	$0, 136(%rsp)
	movq	$0, 128(%rsp)
	movq	$0, 120(%rsp)
	movq	$0, 72(%rsp)
	movq	$0, 64(%rsp)
	movq	$0, 56(%rsp)
	movq	$0, 48(%rsp)
	movq	352(%rsp), %rbx
	movq	224(%rsp), %r14
	movq	%rcx, 40(%rsp)
	movq	%rdx, 32(%rsp)
	movq	%rdi, 112(%rsp)
	leaq	7(%rax), %r12
	movq	32(%r13), %rbp
	movq	%r12, 24(%rsp)
	shrq	$3, %r12
	testq	%rax, %rax
	setle	%al
	testq	%r12, %r12
	sete	%cl
	orb	%al, %cl
	movb	%cl, 15(%rsp)
	jne	.LBB4_85
	movl	%r12d, %eax
	andl	$7, %eax
	cmpq	$64, 24(%rsp)
	movabsq	$.LCPI4_0, %rsi
	jae	.LBB4_3
	xorl	%edi, %edi
	jmp	.LBB4_8
.LBB4_3:
	leaq	-8(%r12), %rcx
	movq	%rcx, %rdx
	shrq	$3, %rdx
	je	.LBB4_4
	vbroadcastsd	(%rsi), %zmm0
	leaq	1(%rdx), %r8
	leaq	7872(%rbx), %r9
	xorl	%edi, %edi
	andq	$-2, %r8
	.p2align	4
.LBB4_13:
	vmulpd	-7360(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -1216(%r9,%rdi,8)
	vmulpd	-7296(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -1152(%r9,%rdi,8)
	vmulpd	-7232(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -1088(%r9,%rdi,8)
	vmulpd	-7168(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -1024(%r9,%rdi,8)
	vmulpd	-7104(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -960(%r9,%rdi,8)
	vmulpd	-7040(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -896(%r9,%rdi,8)
	vmulpd	-6976(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -832(%r9,%rdi,8)
	vmulpd	-6912(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -768(%r9,%rdi,8)
	vmulpd	-6848(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -704(%r9,%rdi,8)
	vmulpd	-6784(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -640(%r9,%rdi,8)
	vmulpd	-6720(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -576(%r9,%rdi,8)
	vmulpd	-6656(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -512(%r9,%rdi,8)
	vmulpd	-6592(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -448(%r9,%rdi,8)
	vmulpd	-5824(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -192(%r9,%rdi,8)
	vmulpd	-6528(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -384(%r9,%rdi,8)
	vmulpd	-5760(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -128(%r9,%rdi,8)
	vmulpd	-6464(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -320(%r9,%rdi,8)
	vmulpd	-5696(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -64(%r9,%rdi,8)
	vmulpd	-6400(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -256(%r9,%rdi,8)
	vmulpd	-5632(%r9,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, (%r9,%rdi,8)
	subq	$-128, %rdi
	addq	$-2, %r8
	jne	.LBB4_13
	testb	$8, %cl
	je	.LBB4_6
	testq	%rax, %rax
	jne	.LBB4_8
.LBB4_73:
	testq	%rdx, %rdx
	je	.LBB4_74
.LBB4_75:
	incq	%rdx
	xorl	%esi, %esi
	andq	$-2, %rdx
	.p2align	4
.LBB4_76:
	vmovups	(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, (%rdi,%rsi,8)
	vmovups	64(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 64(%rdi,%rsi,8)
	vmovups	128(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 128(%rdi,%rsi,8)
	vmovups	192(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 192(%rdi,%rsi,8)
	vmovups	256(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 256(%rdi,%rsi,8)
	vmovups	320(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 320(%rdi,%rsi,8)
	vmovups	384(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 384(%rdi,%rsi,8)
	vmovups	448(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 448(%rdi,%rsi,8)
	vmovups	512(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 512(%rdi,%rsi,8)
	vmovups	576(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 576(%rdi,%rsi,8)
	vmovups	640(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 640(%rdi,%rsi,8)
	vmovups	704(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 704(%rdi,%rsi,8)
	vmovups	768(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 768(%rdi,%rsi,8)
	vmovups	832(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 832(%rdi,%rsi,8)
	vmovups	896(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	vmovups	%zmm0, 896(%rdi,%rsi,8)
	vmovupd	960(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%r14, %rdi
	addq	$-2, %rdx
	vmovupd	%zmm0, 960(%rdi,%rsi,8)
	leaq	128(%rsi), %rsi
	jne	.LBB4_76
	testb	$8, %cl
	je	.LBB4_78
	testq	%rax, %rax
	jne	.LBB4_80
	jmp	.LBB4_83
.LBB4_4:
	xorl	%edi, %edi
.LBB4_6:
	vbroadcastsd	(%rsi), %zmm0
	vmulpd	512(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6656(%rbx,%rdi,8)
	vmulpd	576(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6720(%rbx,%rdi,8)
	vmulpd	640(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6784(%rbx,%rdi,8)
	vmulpd	704(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6848(%rbx,%rdi,8)
	vmulpd	768(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6912(%rbx,%rdi,8)
	vmulpd	1536(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7168(%rbx,%rdi,8)
	vmulpd	832(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6976(%rbx,%rdi,8)
	vmulpd	1600(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7232(%rbx,%rdi,8)
	vmulpd	896(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7040(%rbx,%rdi,8)
	vmulpd	1664(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7296(%rbx,%rdi,8)
	vmulpd	960(%rbx,%rdi,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7104(%rbx,%rdi,8)
	vmulpd	1728(%rbx,%rdi,8), %zmm0, %zmm0
	vsqrtpd	%zmm0, %zmm0
	vmovupd	%zmm0, 7360(%rbx,%rdi,8)
	addq	$64, %rdi
	testq	%rax, %rax
	je	.LBB4_73
.LBB4_8:
	vbroadcastsd	(%rsi), %zmm0
	leaq	6912(%rbx,%rdi,8), %rdx
	movl	%eax, %ecx
	shll	$6, %ecx
	xorl	%edi, %edi
	.p2align	4
.LBB4_9:
	vmulpd	-6400(%rdx,%rdi), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -256(%rdx,%rdi)
	vmulpd	-5632(%rdx,%rdi), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, (%rdx,%rdi)
	addq	$64, %rdi
	cmpq	%rdi, %rcx
	jne	.LBB4_9
	cmpq	$64, 24(%rsp)
	jae	.LBB4_72
	xorl	%esi, %esi
	jmp	.LBB4_81
.LBB4_72:
	leaq	-8(%r12), %rcx
	movq	%rcx, %rdx
	shrq	$3, %rdx
	testq	%rdx, %rdx
	jne	.LBB4_75
.LBB4_74:
	xorl	%esi, %esi
.LBB4_78:
	vmovups	(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rcx
	shlq	$8, %rcx
	addq	%r14, %rcx
	vmovups	%zmm0, (%rcx,%rsi,8)
	vmovups	64(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rcx
	shlq	$8, %rcx
	addq	%r14, %rcx
	vmovups	%zmm0, 64(%rcx,%rsi,8)
	vmovups	128(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rcx
	shlq	$8, %rcx
	addq	%r14, %rcx
	vmovups	%zmm0, 128(%rcx,%rsi,8)
	vmovups	192(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rcx
	shlq	$8, %rcx
	addq	%r14, %rcx
	vmovups	%zmm0, 192(%rcx,%rsi,8)
	vmovups	256(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rcx
	shlq	$8, %rcx
	addq	%r14, %rcx
	vmovups	%zmm0, 256(%rcx,%rsi,8)
	vmovups	320(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rcx
	shlq	$8, %rcx
	addq	%r14, %rcx
	vmovups	%zmm0, 320(%rcx,%rsi,8)
	vmovups	384(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rcx
	shlq	$8, %rcx
	addq	%r14, %rcx
	vmovups	%zmm0, 384(%rcx,%rsi,8)
	vmovupd	448(%rbx,%rsi,8), %zmm0
	movq	8(%r13), %rcx
	shlq	$8, %rcx
	addq	%r14, %rcx
	vmovupd	%zmm0, 448(%rcx,%rsi,8)
	addq	$64, %rsi
	testq	%rax, %rax
	je	.LBB4_83
.LBB4_80:
	shll	$6, %eax
	shlq	$3, %rsi
	movq	%rax, %rcx
.LBB4_81:
	leaq	(%r14,%rsi), %rax
	addq	%rbx, %rsi
	xorl	%edx, %edx
	.p2align	4
.LBB4_82:
	vmovupd	(%rsi,%rdx), %zmm0
	movq	8(%r13), %rdi
	shlq	$8, %rdi
	addq	%rax, %rdi
	vmovupd	%zmm0, (%rdx,%rdi)
	addq	$64, %rdx
	cmpq	%rdx, %rcx
	jne	.LBB4_82
.LBB4_83:
	leaq	256(%rbx), %rax
	leaq	256(%r14), %rcx
	leaq	3(%r12), %rdx
	.p2align	4
.LBB4_84:
	vmovupd	(%rax), %zmm0
	movq	8(%r13), %rsi
	addq	$64, %rax
	decq	%rdx
	shlq	$8, %rsi
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rcx
	cmpq	$3, %rdx
	ja	.LBB4_84
.LBB4_85:
	movq	400(%rsp), %r15
	addq	392(%rsp), %rbp
	leaq	144(%rsp), %rdi
	leaq	136(%rsp), %rsi
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%r15, %r8
	vzeroupper
	callq	*32(%rsp)
	leaq	128(%rsp), %rdi
	leaq	120(%rsp), %rsi
	movl	%eax, 108(%rsp)
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%r15, %r8
	callq	*40(%rsp)
	cmpb	$0, 15(%rsp)
	movl	%eax, 104(%rsp)
	je	.LBB4_90
	leaq	8(%r13), %r15
	shlq	$8, %rbp
	jmp	.LBB4_87
.LBB4_90:
	movl	%r12d, %eax
	shlq	$8, %rbp
	andl	$7, %eax
	cmpq	$64, 24(%rsp)
	jae	.LBB4_92
	xorl	%edi, %edi
	jmp	.LBB4_99
.LBB4_92:
	leaq	-8(%r12), %rcx
	shrq	$3, %rcx
	je	.LBB4_93
	movabsq	$4611686018427387900, %rdx
	incq	%rcx
	leaq	960(%rbp,%r14), %rsi
	xorl	%edi, %edi
	orq	$2, %rdx
	andq	%rcx, %rdx
	.p2align	4
.LBB4_95:
	vmovups	-960(%rsi,%rdi,8), %zmm0
	addq	$-2, %rdx
	vmovups	%zmm0, 14336(%rbx,%rdi,8)
	vmovups	-960(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14080(%rbx,%rdi,8)
	vmovups	-896(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14400(%rbx,%rdi,8)
	vmovups	-896(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14144(%rbx,%rdi,8)
	vmovups	-832(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14464(%rbx,%rdi,8)
	vmovups	-832(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14208(%rbx,%rdi,8)
	vmovups	-768(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14528(%rbx,%rdi,8)
	vmovups	-768(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14272(%rbx,%rdi,8)
	vmovups	-704(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14592(%rbx,%rdi,8)
	vmovups	-704(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14336(%rbx,%rdi,8)
	vmovups	-640(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14656(%rbx,%rdi,8)
	vmovups	-640(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14400(%rbx,%rdi,8)
	vmovups	-576(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14720(%rbx,%rdi,8)
	vmovups	-576(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14464(%rbx,%rdi,8)
	vmovups	-512(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14784(%rbx,%rdi,8)
	vmovups	-512(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14528(%rbx,%rdi,8)
	vmovups	-448(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14848(%rbx,%rdi,8)
	vmovups	-448(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14592(%rbx,%rdi,8)
	vmovups	-384(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14912(%rbx,%rdi,8)
	vmovups	-384(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14656(%rbx,%rdi,8)
	vmovups	-320(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14976(%rbx,%rdi,8)
	vmovups	-320(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14720(%rbx,%rdi,8)
	vmovups	-256(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 15040(%rbx,%rdi,8)
	vmovups	-256(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14784(%rbx,%rdi,8)
	vmovups	-192(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 15104(%rbx,%rdi,8)
	vmovups	-192(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14848(%rbx,%rdi,8)
	vmovups	-128(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 15168(%rbx,%rdi,8)
	vmovups	-128(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14912(%rbx,%rdi,8)
	vmovups	-64(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 15232(%rbx,%rdi,8)
	vmovups	-64(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 14976(%rbx,%rdi,8)
	vmovups	(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 15296(%rbx,%rdi,8)
	vmovupd	(%rsi,%rdi,8), %zmm0
	vmovupd	%zmm0, 15040(%rbx,%rdi,8)
	leaq	128(%rdi), %rdi
	jne	.LBB4_95
	testb	$1, %cl
	jne	.LBB4_97
	testq	%rax, %rax
	jne	.LBB4_99
	jmp	.LBB4_101
.LBB4_93:
	xorl	%edi, %edi
.LBB4_97:
	leaq	448(%r14,%rbp), %rcx
	vmovups	-448(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14336(%rbx,%rdi,8)
	vmovups	-448(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14080(%rbx,%rdi,8)
	vmovups	-384(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14400(%rbx,%rdi,8)
	vmovups	-384(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14144(%rbx,%rdi,8)
	vmovups	-320(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14464(%rbx,%rdi,8)
	vmovups	-320(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14208(%rbx,%rdi,8)
	vmovups	-256(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14528(%rbx,%rdi,8)
	vmovups	-256(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14272(%rbx,%rdi,8)
	vmovups	-192(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14592(%rbx,%rdi,8)
	vmovups	-192(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14336(%rbx,%rdi,8)
	vmovups	-128(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14656(%rbx,%rdi,8)
	vmovups	-128(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14400(%rbx,%rdi,8)
	vmovups	-64(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14720(%rbx,%rdi,8)
	vmovups	-64(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14464(%rbx,%rdi,8)
	vmovups	(%rcx,%rdi,8), %zmm0
	vmovups	%zmm0, 14784(%rbx,%rdi,8)
	vmovupd	(%rcx,%rdi,8), %zmm0
	vmovupd	%zmm0, 14528(%rbx,%rdi,8)
	addq	$64, %rdi
	testq	%rax, %rax
	je	.LBB4_101
.LBB4_99:
	leaq	(%r14,%rbp), %rdx
	leaq	14336(%rbx,%rdi,8), %rcx
	shll	$6, %eax
	xorl	%esi, %esi
	leaq	(%rdx,%rdi,8), %rdx
	.p2align	4
.LBB4_100:
	vmovups	(%rdx,%rsi), %zmm0
	vmovups	%zmm0, (%rcx,%rsi)
	vmovupd	(%rdx,%rsi), %zmm0
	vmovupd	%zmm0, -256(%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rax
	jne	.LBB4_100
.LBB4_101:
	movabsq	$.LCPI4_2, %rcx
	movabsq	$.LCPI4_3, %rdx
	movabsq	$.LCPI4_1, %rsi
	leaq	8(%r13), %r15
	leaq	2(%r12), %rax
	vbroadcastsd	(%rcx), %zmm0
	vbroadcastsd	(%rdx), %zmm2
	vbroadcastsd	(%rsi), %zmm1
	movq	%rbx, %rcx
	movq	%r14, %rdx
	.p2align	4
.LBB4_102:
	vmovupd	(%rcx), %zmm3
	movq	(%r15), %rsi
	decq	%rax
	shlq	$8, %rsi
	vandpd	%zmm1, %zmm3, %zmm4
	vaddpd	%zmm0, %zmm4, %zmm4
	vmulpd	%zmm2, %zmm4, %zmm4
	vaddpd	6656(%rcx), %zmm4, %zmm4
	addq	$64, %rcx
	vaddpd	%zmm4, %zmm3, %zmm3
	vmovupd	%zmm3, (%rdx,%rsi)
	addq	$64, %rdx
	cmpq	$2, %rax
	ja	.LBB4_102
.LBB4_87:
	movq	%rbp, 16(%rsp)
	movq	400(%rsp), %rbp
	leaq	72(%rsp), %rdi
	leaq	64(%rsp), %rsi
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%rbp, %r8
	vzeroupper
	callq	*32(%rsp)
	leaq	56(%rsp), %rdi
	leaq	48(%rsp), %rsi
	movl	%eax, 100(%rsp)
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%rbp, %r8
	callq	*40(%rsp)
	cmpb	$0, 15(%rsp)
	movl	%eax, 96(%rsp)
	jne	.LBB4_48
	movl	%r12d, %eax
	andl	$7, %eax
	cmpq	$64, 24(%rsp)
	jae	.LBB4_103
	movq	16(%rsp), %r8
	xorl	%edi, %edi
	jmp	.LBB4_69
.LBB4_103:
	movq	16(%rsp), %r8
	leaq	-8(%r12), %rsi
	movq	%rsi, %rdx
	shrq	$3, %rdx
	incq	%rdx
	movl	%edx, %ecx
	andl	$3, %ecx
	cmpq	$24, %rsi
	jae	.LBB4_63
	xorl	%edi, %edi
	jmp	.LBB4_66
.LBB4_63:
	leaq	1984(%r8,%r14), %rsi
	andq	$-4, %rdx
	xorl	%edi, %edi
	.p2align	4
.LBB4_64:
	vmovups	-1984(%rsi,%rdi,8), %zmm0
	addq	$-4, %rdx
	vmovups	%zmm0, 7680(%rbx,%rdi,8)
	vmovups	-1920(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 7744(%rbx,%rdi,8)
	vmovups	-1856(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 7808(%rbx,%rdi,8)
	vmovups	-1792(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 7872(%rbx,%rdi,8)
	vmovups	-1728(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 7936(%rbx,%rdi,8)
	vmovups	-1664(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdi,8)
	vmovups	-1600(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdi,8)
	vmovups	-1536(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8128(%rbx,%rdi,8)
	vmovups	-1472(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%rdi,8)
	vmovups	-1408(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%rdi,8)
	vmovups	-1344(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%rdi,8)
	vmovups	-1280(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8384(%rbx,%rdi,8)
	vmovups	-1216(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8448(%rbx,%rdi,8)
	vmovups	-1152(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8512(%rbx,%rdi,8)
	vmovups	-1088(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8576(%rbx,%rdi,8)
	vmovups	-1024(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8640(%rbx,%rdi,8)
	vmovups	-960(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8704(%rbx,%rdi,8)
	vmovups	-896(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8768(%rbx,%rdi,8)
	vmovups	-832(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8832(%rbx,%rdi,8)
	vmovups	-768(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8896(%rbx,%rdi,8)
	vmovups	-704(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8960(%rbx,%rdi,8)
	vmovups	-640(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9024(%rbx,%rdi,8)
	vmovups	-576(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9088(%rbx,%rdi,8)
	vmovups	-512(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9152(%rbx,%rdi,8)
	vmovups	-448(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9216(%rbx,%rdi,8)
	vmovups	-384(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9280(%rbx,%rdi,8)
	vmovups	-320(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9344(%rbx,%rdi,8)
	vmovups	-256(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9408(%rbx,%rdi,8)
	vmovups	-192(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9472(%rbx,%rdi,8)
	vmovups	-128(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9536(%rbx,%rdi,8)
	vmovups	-64(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9600(%rbx,%rdi,8)
	vmovupd	(%rsi,%rdi,8), %zmm0
	vmovupd	%zmm0, 9664(%rbx,%rdi,8)
	leaq	256(%rdi), %rdi
	jne	.LBB4_64
	testq	%rcx, %rcx
	je	.LBB4_68
.LBB4_66:
	leaq	448(%r14,%r8), %rdx
	negq	%rcx
	.p2align	4
.LBB4_67:
	vmovups	-448(%rdx,%rdi,8), %zmm0
	incq	%rcx
	vmovups	%zmm0, 7680(%rbx,%rdi,8)
	vmovups	-384(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 7744(%rbx,%rdi,8)
	vmovups	-320(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 7808(%rbx,%rdi,8)
	vmovups	-256(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 7872(%rbx,%rdi,8)
	vmovups	-192(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 7936(%rbx,%rdi,8)
	vmovups	-128(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdi,8)
	vmovups	-64(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdi,8)
	vmovupd	(%rdx,%rdi,8), %zmm0
	vmovupd	%zmm0, 8128(%rbx,%rdi,8)
	leaq	64(%rdi), %rdi
	jne	.LBB4_67
.LBB4_68:
	testq	%rax, %rax
	je	.LBB4_71
.LBB4_69:
	leaq	(%r14,%r8), %rdx
	leaq	7680(%rbx,%rdi,8), %rcx
	shll	$6, %eax
	xorl	%esi, %esi
	leaq	(%rdx,%rdi,8), %rdx
	.p2align	4
.LBB4_70:
	vmovupd	(%rdx,%rsi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rax
	jne	.LBB4_70
.LBB4_71:
	movabsq	$.LCPI4_2, %rcx
	movabsq	$.LCPI4_3, %rdx
	movabsq	$.LCPI4_1, %rsi
	leaq	2(%r12), %rax
	vbroadcastsd	(%rcx), %zmm0
	vbroadcastsd	(%rdx), %zmm2
	vbroadcastsd	(%rsi), %zmm1
	movq	%rbx, %rcx
	movq	%r14, %rdx
	.p2align	4
.LBB4_47:
	vmovupd	(%rcx), %zmm3
	movq	(%r15), %rsi
	decq	%rax
	shlq	$8, %rsi
	vandpd	%zmm1, %zmm3, %zmm4
	vaddpd	%zmm0, %zmm4, %zmm4
	vmulpd	%zmm2, %zmm4, %zmm4
	vaddpd	6656(%rcx), %zmm4, %zmm4
	addq	$64, %rcx
	vsubpd	%zmm4, %zmm3, %zmm3
	vmovupd	%zmm3, (%rdx,%rsi)
	addq	$64, %rdx
	cmpq	$2, %rax
	ja	.LBB4_47
.LBB4_48:
	movq	400(%rsp), %rbp
	leaq	72(%rsp), %rdi
	leaq	64(%rsp), %rsi
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%rbp, %r8
	vzeroupper
	callq	*32(%rsp)
	leaq	56(%rsp), %rdi
	leaq	48(%rsp), %rsi
	movl	%eax, 92(%rsp)
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%rbp, %r8
	callq	*40(%rsp)
	cmpb	$0, 15(%rsp)
	movq	16(%rsp), %r8
	movabsq	$.LCPI4_4, %r9
	movl	%eax, 88(%rsp)
	jne	.LBB4_16
	movl	%r12d, %eax
	andl	$7, %eax
	cmpq	$64, 24(%rsp)
	jae	.LBB4_51
	xorl	%edi, %edi
	jmp	.LBB4_59
.LBB4_51:
	leaq	-8(%r12), %rsi
	movq	%rsi, %rdx
	shrq	$3, %rdx
	incq	%rdx
	movl	%edx, %ecx
	andl	$3, %ecx
	cmpq	$24, %rsi
	jae	.LBB4_53
	xorl	%edi, %edi
	jmp	.LBB4_56
.LBB4_53:
	leaq	1984(%r8,%r14), %rsi
	andq	$-4, %rdx
	xorl	%edi, %edi
	.p2align	4
.LBB4_54:
	vmovups	-1984(%rsi,%rdi,8), %zmm0
	addq	$-4, %rdx
	vmovups	%zmm0, 7936(%rbx,%rdi,8)
	vmovups	-1920(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdi,8)
	vmovups	-1856(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdi,8)
	vmovups	-1792(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8128(%rbx,%rdi,8)
	vmovups	-1728(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%rdi,8)
	vmovups	-1664(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%rdi,8)
	vmovups	-1600(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%rdi,8)
	vmovups	-1536(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8384(%rbx,%rdi,8)
	vmovups	-1472(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8448(%rbx,%rdi,8)
	vmovups	-1408(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8512(%rbx,%rdi,8)
	vmovups	-1344(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8576(%rbx,%rdi,8)
	vmovups	-1280(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8640(%rbx,%rdi,8)
	vmovups	-1216(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8704(%rbx,%rdi,8)
	vmovups	-1152(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8768(%rbx,%rdi,8)
	vmovups	-1088(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8832(%rbx,%rdi,8)
	vmovups	-1024(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8896(%rbx,%rdi,8)
	vmovups	-960(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8960(%rbx,%rdi,8)
	vmovups	-896(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9024(%rbx,%rdi,8)
	vmovups	-832(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9088(%rbx,%rdi,8)
	vmovups	-768(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9152(%rbx,%rdi,8)
	vmovups	-704(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9216(%rbx,%rdi,8)
	vmovups	-640(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9280(%rbx,%rdi,8)
	vmovups	-576(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9344(%rbx,%rdi,8)
	vmovups	-512(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9408(%rbx,%rdi,8)
	vmovups	-448(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9472(%rbx,%rdi,8)
	vmovups	-384(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9536(%rbx,%rdi,8)
	vmovups	-320(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9600(%rbx,%rdi,8)
	vmovups	-256(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9664(%rbx,%rdi,8)
	vmovups	-192(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9728(%rbx,%rdi,8)
	vmovups	-128(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9792(%rbx,%rdi,8)
	vmovups	-64(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9856(%rbx,%rdi,8)
	vmovupd	(%rsi,%rdi,8), %zmm0
	vmovupd	%zmm0, 9920(%rbx,%rdi,8)
	leaq	256(%rdi), %rdi
	jne	.LBB4_54
	testq	%rcx, %rcx
	je	.LBB4_58
.LBB4_56:
	leaq	448(%r14,%r8), %rdx
	negq	%rcx
	.p2align	4
.LBB4_57:
	vmovups	-448(%rdx,%rdi,8), %zmm0
	incq	%rcx
	vmovups	%zmm0, 7936(%rbx,%rdi,8)
	vmovups	-384(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdi,8)
	vmovups	-320(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdi,8)
	vmovups	-256(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8128(%rbx,%rdi,8)
	vmovups	-192(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%rdi,8)
	vmovups	-128(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%rdi,8)
	vmovups	-64(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%rdi,8)
	vmovupd	(%rdx,%rdi,8), %zmm0
	vmovupd	%zmm0, 8384(%rbx,%rdi,8)
	leaq	64(%rdi), %rdi
	jne	.LBB4_57
.LBB4_58:
	testq	%rax, %rax
	je	.LBB4_61
.LBB4_59:
	leaq	(%r14,%r8), %rdx
	leaq	7936(%rbx,%rdi,8), %rcx
	shll	$6, %eax
	xorl	%esi, %esi
	leaq	(%rdx,%rdi,8), %rdx
	.p2align	4
.LBB4_60:
	vmovupd	(%rdx,%rsi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rax
	jne	.LBB4_60
.LBB4_61:
	movabsq	$.LCPI4_2, %rcx
	movabsq	$.LCPI4_3, %rdx
	vbroadcastsd	(%r9), %zmm3
	leaq	14336(%rbx), %rax
	vbroadcastsd	(%rcx), %zmm0
	vbroadcastsd	(%rdx), %zmm1
	movabsq	$.LCPI4_1, %rdx
	leaq	2(%r12), %rcx
	vbroadcastsd	(%rdx), %zmm2
	movq	%r14, %rdx
	.p2align	4
.LBB4_62:
	vmovupd	-14336(%rax), %zmm4
	vmovupd	-6656(%rax), %zmm7
	vmovupd	-6400(%rax), %zmm8
	vmovupd	-13824(%rax), %zmm5
	decq	%rcx
	vandpd	%zmm2, %zmm4, %zmm6
	vsubpd	%zmm8, %zmm7, %zmm9
	vaddpd	%zmm5, %zmm5, %zmm5
	vaddpd	%zmm0, %zmm6, %zmm6
	vmulpd	%zmm1, %zmm6, %zmm6
	vaddpd	-7680(%rax), %zmm6, %zmm6
	vdivpd	%zmm6, %zmm3, %zmm6
	vmulpd	%zmm6, %zmm9, %zmm9
	vmulpd	%zmm5, %zmm6, %zmm5
	vmovupd	%zmm9, -2048(%rax)
	vmulpd	%zmm5, %zmm6, %zmm5
	vaddpd	%zmm8, %zmm7, %zmm6
	vmovupd	(%rax), %zmm7
	vaddpd	%zmm7, %zmm7, %zmm7
	vsubpd	%zmm7, %zmm6, %zmm6
	vmulpd	%zmm6, %zmm5, %zmm5
	vaddpd	-256(%rax), %zmm5, %zmm5
	vmovupd	%zmm5, -256(%rax)
	addq	$64, %rax
	movq	(%r15), %rsi
	shlq	$8, %rsi
	vmovupd	%zmm4, (%rdx,%rsi)
	addq	$64, %rdx
	cmpq	$2, %rcx
	ja	.LBB4_62
	leaq	256(%rbx), %rax
	leaq	256(%r14), %rcx
	leaq	2(%r12), %rdx
	.p2align	4
.LBB4_15:
	vmovupd	(%rax), %zmm3
	movq	(%r15), %rsi
	decq	%rdx
	shlq	$8, %rsi
	vandpd	%zmm2, %zmm3, %zmm4
	vaddpd	%zmm0, %zmm4, %zmm4
	vmulpd	%zmm1, %zmm4, %zmm4
	vaddpd	6656(%rax), %zmm4, %zmm4
	addq	$64, %rax
	vaddpd	%zmm4, %zmm3, %zmm3
	vmovupd	%zmm3, (%rcx,%rsi)
	addq	$64, %rcx
	cmpq	$2, %rdx
	ja	.LBB4_15
.LBB4_16:
	movq	400(%rsp), %rbp
	leaq	72(%rsp), %rdi
	leaq	64(%rsp), %rsi
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%rbp, %r8
	vzeroupper
	callq	*32(%rsp)
	leaq	56(%rsp), %rdi
	leaq	48(%rsp), %rsi
	movl	%eax, 84(%rsp)
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%rbp, %r8
	callq	*40(%rsp)
	cmpb	$0, 15(%rsp)
	movl	%eax, 80(%rsp)
	jne	.LBB4_31
	movl	%r12d, %eax
	andl	$7, %eax
	cmpq	$64, 24(%rsp)
	jae	.LBB4_19
	xorl	%edi, %edi
	jmp	.LBB4_27
.LBB4_19:
	leaq	-8(%r12), %rsi
	movq	%rsi, %rdx
	shrq	$3, %rdx
	incq	%rdx
	movl	%edx, %ecx
	andl	$3, %ecx
	cmpq	$24, %rsi
	jae	.LBB4_21
	xorl	%edi, %edi
	jmp	.LBB4_24
.LBB4_21:
	movq	16(%rsp), %rsi
	andq	$-4, %rdx
	xorl	%edi, %edi
	leaq	1984(%rsi,%r14), %rsi
	.p2align	4
.LBB4_22:
	vmovups	-1984(%rsi,%rdi,8), %zmm0
	addq	$-4, %rdx
	vmovups	%zmm0, 7680(%rbx,%rdi,8)
	vmovups	-1920(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 7744(%rbx,%rdi,8)
	vmovups	-1856(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 7808(%rbx,%rdi,8)
	vmovups	-1792(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 7872(%rbx,%rdi,8)
	vmovups	-1728(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 7936(%rbx,%rdi,8)
	vmovups	-1664(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdi,8)
	vmovups	-1600(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdi,8)
	vmovups	-1536(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8128(%rbx,%rdi,8)
	vmovups	-1472(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%rdi,8)
	vmovups	-1408(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%rdi,8)
	vmovups	-1344(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%rdi,8)
	vmovups	-1280(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8384(%rbx,%rdi,8)
	vmovups	-1216(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8448(%rbx,%rdi,8)
	vmovups	-1152(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8512(%rbx,%rdi,8)
	vmovups	-1088(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8576(%rbx,%rdi,8)
	vmovups	-1024(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8640(%rbx,%rdi,8)
	vmovups	-960(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8704(%rbx,%rdi,8)
	vmovups	-896(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8768(%rbx,%rdi,8)
	vmovups	-832(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8832(%rbx,%rdi,8)
	vmovups	-768(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8896(%rbx,%rdi,8)
	vmovups	-704(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 8960(%rbx,%rdi,8)
	vmovups	-640(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9024(%rbx,%rdi,8)
	vmovups	-576(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9088(%rbx,%rdi,8)
	vmovups	-512(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9152(%rbx,%rdi,8)
	vmovups	-448(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9216(%rbx,%rdi,8)
	vmovups	-384(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9280(%rbx,%rdi,8)
	vmovups	-320(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9344(%rbx,%rdi,8)
	vmovups	-256(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9408(%rbx,%rdi,8)
	vmovups	-192(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9472(%rbx,%rdi,8)
	vmovups	-128(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9536(%rbx,%rdi,8)
	vmovups	-64(%rsi,%rdi,8), %zmm0
	vmovups	%zmm0, 9600(%rbx,%rdi,8)
	vmovupd	(%rsi,%rdi,8), %zmm0
	vmovupd	%zmm0, 9664(%rbx,%rdi,8)
	leaq	256(%rdi), %rdi
	jne	.LBB4_22
	testq	%rcx, %rcx
	je	.LBB4_26
.LBB4_24:
	movq	16(%rsp), %rdx
	negq	%rcx
	leaq	448(%r14,%rdx), %rdx
	.p2align	4
.LBB4_25:
	vmovups	-448(%rdx,%rdi,8), %zmm0
	incq	%rcx
	vmovups	%zmm0, 7680(%rbx,%rdi,8)
	vmovups	-384(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 7744(%rbx,%rdi,8)
	vmovups	-320(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 7808(%rbx,%rdi,8)
	vmovups	-256(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 7872(%rbx,%rdi,8)
	vmovups	-192(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 7936(%rbx,%rdi,8)
	vmovups	-128(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdi,8)
	vmovups	-64(%rdx,%rdi,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdi,8)
	vmovupd	(%rdx,%rdi,8), %zmm0
	vmovupd	%zmm0, 8128(%rbx,%rdi,8)
	leaq	64(%rdi), %rdi
	jne	.LBB4_25
.LBB4_26:
	testq	%rax, %rax
	je	.LBB4_29
.LBB4_27:
	movq	16(%rsp), %rdx
	leaq	7680(%rbx,%rdi,8), %rcx
	shll	$6, %eax
	xorl	%esi, %esi
	addq	%r14, %rdx
	leaq	(%rdx,%rdi,8), %rdx
	.p2align	4
.LBB4_28:
	vmovupd	(%rdx,%rsi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rax
	jne	.LBB4_28
.LBB4_29:
	movabsq	$.LCPI4_2, %r8
	movabsq	$.LCPI4_3, %rdi
	movabsq	$.LCPI4_1, %rsi
	leaq	256(%rbx), %rax
	leaq	256(%r14), %rcx
	leaq	2(%r12), %rdx
	vbroadcastsd	(%r8), %zmm1
	vbroadcastsd	(%rdi), %zmm2
	vbroadcastsd	(%rsi), %zmm0
	.p2align	4
.LBB4_30:
	vmovupd	(%rax), %zmm3
	movq	(%r15), %rsi
	decq	%rdx
	shlq	$8, %rsi
	vandpd	%zmm0, %zmm3, %zmm4
	vaddpd	%zmm1, %zmm4, %zmm4
	vmulpd	%zmm2, %zmm4, %zmm4
	vaddpd	6656(%rax), %zmm4, %zmm4
	addq	$64, %rax
	vsubpd	%zmm4, %zmm3, %zmm3
	vmovupd	%zmm3, (%rcx,%rsi)
	addq	$64, %rcx
	cmpq	$2, %rdx
	ja	.LBB4_30
.LBB4_31:
	movq	400(%rsp), %rbp
	leaq	72(%rsp), %rdi
	leaq	64(%rsp), %rsi
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%rbp, %r8
	vzeroupper
	callq	*32(%rsp)
	leaq	56(%rsp), %rdi
	leaq	48(%rsp), %rsi
	movl	%eax, 32(%rsp)
	movq	%r14, %rdx
	movq	%r13, %rcx
	movq	%rbp, %r8
	callq	*40(%rsp)
	cmpb	$0, 15(%rsp)
	jne	.LBB4_46
	movl	%r12d, %ecx
	andl	$7, %ecx
	cmpq	$64, 24(%rsp)
	jae	.LBB4_34
	xorl	%r8d, %r8d
	movabsq	$.LCPI4_4, %r9
	jmp	.LBB4_42
.LBB4_34:
	leaq	-8(%r12), %rdi
	movabsq	$.LCPI4_4, %r9
	movq	%rdi, %rsi
	shrq	$3, %rsi
	incq	%rsi
	movl	%esi, %edx
	andl	$3, %edx
	cmpq	$24, %rdi
	jae	.LBB4_36
	xorl	%r8d, %r8d
	jmp	.LBB4_39
.LBB4_36:
	movq	16(%rsp), %rdi
	andq	$-4, %rsi
	xorl	%r8d, %r8d
	leaq	1984(%rdi,%r14), %rdi
	.p2align	4
.LBB4_37:
	vmovups	-1984(%rdi,%r8,8), %zmm0
	addq	$-4, %rsi
	vmovups	%zmm0, 7936(%rbx,%r8,8)
	vmovups	-1920(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%r8,8)
	vmovups	-1856(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%r8,8)
	vmovups	-1792(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8128(%rbx,%r8,8)
	vmovups	-1728(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%r8,8)
	vmovups	-1664(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%r8,8)
	vmovups	-1600(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%r8,8)
	vmovups	-1536(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8384(%rbx,%r8,8)
	vmovups	-1472(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8448(%rbx,%r8,8)
	vmovups	-1408(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8512(%rbx,%r8,8)
	vmovups	-1344(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8576(%rbx,%r8,8)
	vmovups	-1280(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8640(%rbx,%r8,8)
	vmovups	-1216(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8704(%rbx,%r8,8)
	vmovups	-1152(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8768(%rbx,%r8,8)
	vmovups	-1088(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8832(%rbx,%r8,8)
	vmovups	-1024(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8896(%rbx,%r8,8)
	vmovups	-960(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 8960(%rbx,%r8,8)
	vmovups	-896(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9024(%rbx,%r8,8)
	vmovups	-832(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9088(%rbx,%r8,8)
	vmovups	-768(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9152(%rbx,%r8,8)
	vmovups	-704(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9216(%rbx,%r8,8)
	vmovups	-640(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9280(%rbx,%r8,8)
	vmovups	-576(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9344(%rbx,%r8,8)
	vmovups	-512(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9408(%rbx,%r8,8)
	vmovups	-448(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9472(%rbx,%r8,8)
	vmovups	-384(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9536(%rbx,%r8,8)
	vmovups	-320(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9600(%rbx,%r8,8)
	vmovups	-256(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9664(%rbx,%r8,8)
	vmovups	-192(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9728(%rbx,%r8,8)
	vmovups	-128(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9792(%rbx,%r8,8)
	vmovups	-64(%rdi,%r8,8), %zmm0
	vmovups	%zmm0, 9856(%rbx,%r8,8)
	vmovupd	(%rdi,%r8,8), %zmm0
	vmovupd	%zmm0, 9920(%rbx,%r8,8)
	leaq	256(%r8), %r8
	jne	.LBB4_37
	testq	%rdx, %rdx
	je	.LBB4_41
.LBB4_39:
	movq	16(%rsp), %rsi
	negq	%rdx
	leaq	448(%r14,%rsi), %rsi
	.p2align	4
.LBB4_40:
	vmovups	-448(%rsi,%r8,8), %zmm0
	incq	%rdx
	vmovups	%zmm0, 7936(%rbx,%r8,8)
	vmovups	-384(%rsi,%r8,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%r8,8)
	vmovups	-320(%rsi,%r8,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%r8,8)
	vmovups	-256(%rsi,%r8,8), %zmm0
	vmovups	%zmm0, 8128(%rbx,%r8,8)
	vmovups	-192(%rsi,%r8,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%r8,8)
	vmovups	-128(%rsi,%r8,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%r8,8)
	vmovups	-64(%rsi,%r8,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%r8,8)
	vmovupd	(%rsi,%r8,8), %zmm0
	vmovupd	%zmm0, 8384(%rbx,%r8,8)
	leaq	64(%r8), %r8
	jne	.LBB4_40
.LBB4_41:
	testq	%rcx, %rcx
	je	.LBB4_44
.LBB4_42:
	movq	16(%rsp), %rsi
	leaq	7936(%rbx,%r8,8), %rdx
	shll	$6, %ecx
	xorl	%edi, %edi
	addq	%r14, %rsi
	leaq	(%rsi,%r8,8), %rsi
	.p2align	4
.LBB4_43:
	vmovupd	(%rsi,%rdi), %zmm0
	vmovupd	%zmm0, (%rdx,%rdi)
	addq	$64, %rdi
	cmpq	%rdi, %rcx
	jne	.LBB4_43
.LBB4_44:
	movabsq	$.LCPI4_2, %rsi
	movabsq	$.LCPI4_3, %rdx
	movabsq	$.LCPI4_1, %rcx
	vbroadcastsd	(%r9), %zmm3
	addq	$256, %r14
	addq	$14336, %rbx
	addq	$2, %r12
	vbroadcastsd	(%rsi), %zmm1
	vbroadcastsd	(%rdx), %zmm2
	vbroadcastsd	(%rcx), %zmm0
	.p2align	4
.LBB4_45:
	vmovupd	-14080(%rbx), %zmm4
	vmovupd	-6656(%rbx), %zmm6
	vmovupd	-6400(%rbx), %zmm7
	decq	%r12
	vandpd	%zmm0, %zmm4, %zmm5
	vsubpd	%zmm7, %zmm6, %zmm8
	vaddpd	%zmm7, %zmm6, %zmm6
	vaddpd	%zmm1, %zmm5, %zmm5
	vmulpd	%zmm2, %zmm5, %zmm5
	vaddpd	-7424(%rbx), %zmm5, %zmm5
	vdivpd	%zmm5, %zmm3, %zmm5
	vmulpd	%zmm5, %zmm8, %zmm8
	vmovupd	%zmm8, -1792(%rbx)
	vmovupd	-13056(%rbx), %zmm8
	vmovupd	(%rbx), %zmm7
	vaddpd	%zmm8, %zmm8, %zmm8
	vaddpd	%zmm7, %zmm7, %zmm7
	vmulpd	%zmm8, %zmm5, %zmm8
	vsubpd	%zmm7, %zmm6, %zmm6
	vmulpd	%zmm8, %zmm5, %zmm5
	vmulpd	%zmm6, %zmm5, %zmm5
	vaddpd	-256(%rbx), %zmm5, %zmm5
	vmovupd	%zmm5, -256(%rbx)
	addq	$64, %rbx
	movq	(%r15), %rcx
	shlq	$8, %rcx
	vmovupd	%zmm4, (%r14,%rcx)
	addq	$64, %r14
	cmpq	$2, %r12
	ja	.LBB4_45
.LBB4_46:
	movl	104(%rsp), %ecx
	movl	100(%rsp), %edx
	movl	92(%rsp), %edi
	movl	80(%rsp), %esi
	orl	88(%rsp), %edi
	orl	108(%rsp), %ecx
	orl	96(%rsp), %edx
	orl	32(%rsp), %esi
	orl	84(%rsp), %edi
	orl	%ecx, %edx
	orl	%eax, %esi
	orl	%edx, %edi
	movq	112(%rsp), %rdx
	orl	%edi, %esi
	movslq	%esi, %rax
	movq	%rax, (%rdx)
	xorl	%eax, %eax
	addq	$152, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.Lfunc_end4:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10linearisedB3v21B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx, .Lfunc_end4-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10linearisedB3v21B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx
	.cfi_endproc

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI5_0:
	.quad	0x3ff0000000000000
.LCPI5_1:
	.quad	0x3fe0000000000000
.LCPI5_2:
	.quad	0x7fffffffffffffff
.LCPI5_3:
	.quad	0x7ff0000000000000
.LCPI5_5:
	.quad	8
	.section	.rodata,"a",@progbits
	.p2align	6, 0x0
.LCPI5_4:
	.quad	0
	.quad	1
	.quad	2
	.quad	3
	.quad	4
	.quad	5
	.quad	6
	.quad	7
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9correctedB3v52B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdxx5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedExx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9correctedB3v52B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdxx5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedExx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9correctedB3v52B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdxx5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedExx:
	pushq	%rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	subq	$224, %rsp
	movq	672(%rsp), %rax
	movq	280(%rsp), %r13
	movq	%rdi, 152(%rsp)
	leaq	7(%rax), %rcx
	shrq	$3, %rcx
	testq	%rax, %rax
	setle	%al
	testq	%rcx, %rcx
	movq	%rcx, 136(%rsp)
	sete	%cl
	orb	%al, %cl
	je	.LBB5_4
.LBB5_1:
	movq	672(%rsp), %rdi
	movq	464(%rsp), %rdx
	testq	%rdi, %rdi
	jle	.LBB5_68
	movq	296(%rsp), %rcx
	movq	664(%rsp), %rax
	movq	632(%rsp), %r10
	movq	624(%rsp), %rbp
	movq	544(%rsp), %r14
	movq	536(%rsp), %r12
	movq	520(%rsp), %r8
	movq	%r13, %rsi
	imulq	$176, %rcx, %r11
	leaq	(%rcx,%rcx,2), %rcx
	movq	%rax, %rbx
	sarq	$63, %rbx
	movq	%rbx, %r15
	andq	%r12, %r15
	andq	%rbp, %rbx
	shlq	$6, %rcx
	addq	%rax, %r15
	addq	%rax, %rbx
	addq	%rsi, %rcx
	addq	%r13, %r11
	movq	%rdx, %r13
	sarq	$63, %r13
	movq	%r15, -104(%rsp)
	movq	%rcx, -120(%rsp)
	movq	%r10, %rcx
	movq	%r14, %r10
	movq	%rcx, %rsi
	imulq	%r12, %r10
	imulq	%rbp, %rsi
	movq	%r13, %r9
	andq	%r14, %r9
	andq	%rcx, %r13
	movq	%r11, -112(%rsp)
	movq	%r13, -128(%rsp)
	movq	%r9, -96(%rsp)
	movq	%r10, -80(%rsp)
	movq	%rsi, -88(%rsp)
	cmpq	$112, %rdi
	jae	.LBB5_47
	movq	%r11, %r9
	movq	-120(%rsp), %r11
	movq	608(%rsp), %rbp
	xorl	%edx, %edx
	jmp	.LBB5_62
.LBB5_4:
	movq	472(%rsp), %r11
	movq	480(%rsp), %rsi
	movq	464(%rsp), %rax
	movq	352(%rsp), %r9
	movabsq	$.LCPI5_1, %rcx
	movabsq	$9223372036854775800, %r14
	vbroadcastsd	%xmm0, %zmm0
	vxorpd	%xmm5, %xmm5, %xmm5
	movq	$0, 112(%rsp)
	vbroadcastsd	(%rcx), %zmm1
	movabsq	$.LCPI5_2, %rcx
	leaq	4(%r14), %rbx
	orq	$6, %r14
	vbroadcastsd	(%rcx), %zmm3
	leaq	3(%r11), %rdx
	movq	%rsi, %r10
	movq	%r11, %rbp
	andq	$-8, %rbp
	leaq	(%rax,%rax,4), %r8
	movl	%r11d, %edi
	andl	$3, %edi
	movl	%r11d, %r15d
	andl	$7, %r15d
	andq	%r11, %rbx
	movq	%r9, -104(%rsp)
	imulq	%rdx, %r10
	movq	%rbp, -40(%rsp)
	movabsq	$.LCPI5_3, %rbp
	movq	%rdx, %rcx
	shlq	$8, %rcx
	movq	%rdi, -8(%rsp)
	shll	$8, %edi
	movq	%rdx, %r12
	imulq	%r11, %r12
	movq	%r15, -96(%rsp)
	movq	%rbx, -32(%rsp)
	movq	%rdx, 184(%rsp)
	vbroadcastsd	(%rbp), %zmm2
	movq	%r11, %rbp
	shlq	$10, %rbp
	movq	%rcx, -48(%rsp)
	movq	%rsi, %rcx
	shlq	$8, %rcx
	movq	%rdi, (%rsp)
	shlq	$8, %r8
	addq	424(%rsp), %r8
	addq	$3072, %rbp
	leaq	(%rsi,%r10), %rax
	movq	%rbp, 176(%rsp)
	movq	%r11, %rbp
	shlq	$8, %rbp
	movq	%r12, -56(%rsp)
	shlq	$8, %r12
	shlq	$8, %r10
	shlq	$8, %rax
	movq	%r10, 216(%rsp)
	leaq	768(%rax,%r9), %rax
	movq	%r8, 8(%rsp)
	movq	%rax, 208(%rsp)
	leaq	(%rbp,%rbp,2), %rax
	leaq	3072(%rcx,%rax), %rax
	movq	%rax, 88(%rsp)
	movq	%r11, %rax
	shlq	$9, %rax
	leaq	2304(%rax,%rcx), %rdi
	addq	$2048, %rax
	movq	%rax, 80(%rsp)
	leaq	(%rsi,%r11), %rax
	movq	%rdi, 72(%rsp)
	leaq	768(%rbp), %rdi
	shlq	$8, %rax
	movq	%rdi, -72(%rsp)
	leaq	2816(%rbp,%rbp,2), %rdi
	addq	$1536, %rax
	addq	$1280, %rbp
	movq	%rax, 64(%rsp)
	leaq	-4(%rbx), %rax
	leaq	-8(%r11), %rbx
	movq	%rdi, 56(%rsp)
	leaq	768(%r9,%rcx), %rdi
	addq	$768, %rcx
	shrq	$3, %rbx
	movq	%rax, 160(%rsp)
	shrq	$2, %rax
	movq	%rbx, -16(%rsp)
	incq	%rax
	movq	%rdi, 192(%rsp)
	movl	%r15d, %edi
	movq	%rcx, %r15
	leaq	768(%r12), %rcx
	andq	%rax, %r14
	movq	%rax, 144(%rsp)
	leaq	(%r9,%r10), %rax
	shll	$8, %edi
	movq	%rcx, 48(%rsp)
	leaq	1792(%r9,%r12), %rcx
	movq	%r14, 168(%rsp)
	leaq	768(%r9,%r12), %r14
	movq	%rax, 200(%rsp)
	leaq	-1(%r11), %rax
	movq	%rax, -64(%rsp)
	leaq	256(%r9), %rax
	movq	%rcx, 16(%rsp)
	leaq	1(%rbx), %rcx
	movabsq	$.LCPI5_0, %rbx
	movq	%r14, 24(%rsp)
	leaq	(%r9,%r12), %r14
	movq	-72(%rsp), %r12
	movq	%rax, -24(%rsp)
	leaq	2560(%r9), %rax
	vbroadcastsd	(%rbx), %zmm4
	movq	%rax, 128(%rsp)
	leaq	512(%r9), %rax
	movq	%rcx, -80(%rsp)
	andq	$-2, %rcx
	movq	%rax, 32(%rsp)
	leaq	4608(%r9), %rax
	negq	%rcx
	movq	%rax, 120(%rsp)
	movl	$512, %eax
	movq	%rcx, -88(%rsp)
	xorl	%ecx, %ecx
	movq	%rax, 40(%rsp)
	jmp	.LBB5_7
	.p2align	4
.LBB5_5:
	movq	-128(%rsp), %rcx
	movq	480(%rsp), %rsi
	movq	352(%rsp), %r9
	movq	8(%rsp), %r8
	movq	216(%rsp), %r10
	movq	104(%rsp), %rbp
	movq	96(%rsp), %r15
	vmovupd	7680(%r13,%rcx,8), %zmm11
	vmovupd	7936(%r13,%rcx,8), %zmm13
	vmovupd	512(%r13,%rcx,8), %zmm10
	vmovupd	768(%r13,%rcx,8), %zmm9
	vmovupd	1280(%r13,%rcx,8), %zmm12
.LBB5_6:
	vmulpd	%zmm8, %zmm6, %zmm14
	vmulpd	%zmm11, %zmm11, %zmm16
	vcmpltpd	%zmm7, %zmm5, %k1
	movabsq	$.LCPI5_0, %rax
	addq	$64, 24(%rsp)
	addq	$64, -24(%rsp)
	addq	$64, 88(%rsp)
	addq	$64, 56(%rsp)
	addq	$64, 48(%rsp)
	addq	$64, 72(%rsp)
	addq	$64, 80(%rsp)
	addq	$64, 64(%rsp)
	addq	$64, 40(%rsp)
	addq	$64, 112(%rsp)
	addq	$64, 128(%rsp)
	addq	$64, -104(%rsp)
	addq	$64, 32(%rsp)
	addq	$64, 120(%rsp)
	addq	$64, 16(%rsp)
	addq	$64, %r14
	addq	$64, %rbp
	addq	$64, %r15
	vmulpd	%zmm14, %zmm11, %zmm15
	vaddpd	(%r13,%rcx,8), %zmm15, %zmm15
	vmulpd	%zmm14, %zmm13, %zmm14
	vmulpd	%zmm11, %zmm13, %zmm11
	vmovupd	%zmm15, (%r13,%rcx,8)
	vaddpd	256(%r13,%rcx,8), %zmm14, %zmm14
	vmovupd	%zmm14, 256(%r13,%rcx,8)
	vmulpd	%zmm16, %zmm8, %zmm14
	vsubpd	%zmm14, %zmm10, %zmm10
	vmaxpd	%zmm10, %zmm5, %zmm10
	vmovupd	%zmm10, 512(%r13,%rcx,8)
	vmulpd	%zmm11, %zmm8, %zmm10
	vsubpd	%zmm10, %zmm9, %zmm9
	vmulpd	%zmm13, %zmm13, %zmm10
	vmulpd	%zmm8, %zmm10, %zmm8
	vmovupd	%zmm9, 768(%r13,%rcx,8)
	vmovupd	%zmm9, 1024(%r13,%rcx,8)
	vandpd	%zmm3, %zmm15, %zmm9
	vsubpd	%zmm8, %zmm12, %zmm8
	vmaxpd	%zmm8, %zmm5, %zmm8
	vmovupd	%zmm8, 1280(%r13,%rcx,8)
	vandpd	%zmm3, %zmm8, %zmm8
	vcmpltpd	13568(%r13,%rcx,8), %zmm1, %k1 {%k1}
	vcmpneq_oqpd	%zmm2, %zmm9, %k1 {%k1}
	vcmpneq_oqpd	%zmm2, %zmm8, %k1 {%k1}
	vbroadcastsd	(%rax), %zmm8 {%k1} {z}
	movq	136(%rsp), %rax
	vmovupd	%zmm8, 13568(%r13,%rcx,8)
	vmovupd	%zmm6, 5632(%r13,%rcx,8)
	vmovupd	%zmm7, 6144(%r13,%rcx,8)
	addq	$8, %rcx
	cmpq	$1, %rax
	leaq	-1(%rax), %rax
	movq	%rax, 136(%rsp)
	jle	.LBB5_1
.LBB5_7:
	vmovupd	512(%r13,%rcx,8), %zmm10
	vmovupd	12288(%r13,%rcx,8), %zmm14
	vmovupd	768(%r13,%rcx,8), %zmm9
	vmovupd	12544(%r13,%rcx,8), %zmm7
	vmovupd	768(%r8,%rcx,8), %zmm8
	leaq	(%r9,%rcx,8), %rbx
	movq	%rcx, -128(%rsp)
	movq	%rbx, -112(%rsp)
	vmulpd	%zmm14, %zmm10, %zmm6
	vmulpd	%zmm7, %zmm9, %zmm11
	vaddpd	%zmm11, %zmm6, %zmm6
	vmulpd	%zmm6, %zmm8, %zmm11
	testq	%rsi, %rsi
	js	.LBB5_9
	vaddpd	256(%rbx,%r10), %zmm11, %zmm11
.LBB5_9:
	movq	-128(%rsp), %rax
	movq	-48(%rsp), %rcx
	vmulpd	14080(%r13,%rax,8), %zmm8, %zmm6
	vmovupd	(%r8,%rax,8), %zmm15
	vaddpd	1024(%r8,%rax,8), %zmm6, %zmm6
	vmovupd	%zmm11, 7680(%r13,%rax,8)
	vmovupd	1280(%r13,%rax,8), %zmm12
	vmulpd	1024(%r13,%rax,8), %zmm14, %zmm13
	vmulpd	%zmm12, %zmm7, %zmm16
	vaddpd	%zmm16, %zmm13, %zmm13
	vmulpd	%zmm13, %zmm8, %zmm13
	testq	%rsi, %rsi
	js	.LBB5_11
	vaddpd	512(%rbx,%r10), %zmm13, %zmm13
.LBB5_11:
	vmulpd	%zmm14, %zmm8, %zmm14
	movq	-128(%rsp), %rbx
	vsubpd	%zmm6, %zmm0, %zmm6
	vmulpd	%zmm11, %zmm14, %zmm16
	vmovupd	%zmm13, 7936(%r13,%rbx,8)
	vaddpd	%zmm16, %zmm15, %zmm16
	vmulpd	%zmm7, %zmm8, %zmm15
	vmulpd	%zmm13, %zmm15, %zmm7
	vaddpd	%zmm7, %zmm16, %zmm7
	testq	%rsi, %rsi
	js	.LBB5_15
	movq	200(%rsp), %rax
	movq	%rsi, %r8
	movq	%r10, %rsi
	movq	-112(%rsp), %r10
	vsubpd	(%rax,%rbx,8), %zmm6, %zmm6
	movq	208(%rsp), %rax
	vmulpd	256(%r10,%rsi), %zmm14, %zmm14
	vmulpd	512(%r10,%rsi), %zmm15, %zmm15
	vaddpd	(%rax,%rbx,8), %zmm14, %zmm14
	vaddpd	%zmm15, %zmm14, %zmm14
	vaddpd	%zmm14, %zmm7, %zmm7
	testq	%r11, %r11
	jle	.LBB5_18
	vmulpd	%zmm5, %zmm7, %zmm9
	movq	%rbp, 104(%rsp)
	movq	%r15, 96(%rsp)
	cmpq	$4, %r11
	jae	.LBB5_20
	xorl	%eax, %eax
	jmp	.LBB5_23
	.p2align	4
.LBB5_15:
	testq	%r11, %r11
	jle	.LBB5_19
	vmulpd	%zmm5, %zmm7, %zmm9
	movq	%rbp, 104(%rsp)
	movq	%r15, 96(%rsp)
	cmpq	$4, %r11
	jae	.LBB5_25
	xorl	%eax, %eax
	jmp	.LBB5_31
	.p2align	4
.LBB5_18:
	movq	%rsi, %r10
	movq	%r8, %rsi
	movq	8(%rsp), %r8
.LBB5_19:
	movq	-128(%rsp), %rcx
	vdivpd	%zmm7, %zmm4, %zmm8
	jmp	.LBB5_6
.LBB5_20:
	movq	-32(%rsp), %rax
	movq	%rbp, %r12
	movq	40(%rsp), %r8
	movq	64(%rsp), %rbp
	movq	80(%rsp), %r11
	movq	72(%rsp), %rbx
	movq	48(%rsp), %rdx
	movq	56(%rsp), %r10
	movq	176(%rsp), %rsi
	movq	-128(%rsp), %rcx
	movq	%rax, -120(%rsp)
	movq	88(%rsp), %rax
	.p2align	4
.LBB5_21:
	vmulpd	12288(%r13,%rcx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rcx,8), %zmm8, %zmm11
	vmulpd	-256(%r9,%r8), %zmm10, %zmm10
	vmulpd	(%r9,%r8), %zmm11, %zmm11
	addq	%rsi, %r8
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vaddpd	(%r9,%r15), %zmm10, %zmm10
	addq	%rsi, %r15
	vmovupd	%zmm10, -768(%r9,%rdx)
	vmulpd	12288(%r13,%rcx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rcx,8), %zmm8, %zmm11
	vmulpd	-256(%r9,%r12), %zmm10, %zmm10
	vmulpd	(%r9,%r12), %zmm11, %zmm11
	addq	%rsi, %r12
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vaddpd	(%r9,%rbp), %zmm10, %zmm10
	addq	%rsi, %rbp
	vmovupd	%zmm10, -512(%r9,%rdx)
	vmulpd	12288(%r13,%rcx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rcx,8), %zmm8, %zmm11
	vmulpd	-256(%r9,%r11), %zmm10, %zmm10
	vmulpd	(%r9,%r11), %zmm11, %zmm11
	addq	%rsi, %r11
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vaddpd	(%r9,%rbx), %zmm10, %zmm10
	addq	%rsi, %rbx
	vmovupd	%zmm10, -256(%r9,%rdx)
	vmulpd	12288(%r13,%rcx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rcx,8), %zmm8, %zmm11
	vmulpd	-256(%r9,%r10), %zmm10, %zmm10
	vmulpd	(%r9,%r10), %zmm11, %zmm11
	addq	%rsi, %r10
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vaddpd	(%r9,%rax), %zmm10, %zmm10
	addq	%rsi, %rax
	vmovupd	%zmm10, (%r9,%rdx)
	addq	$1024, %rdx
	addq	$-4, -120(%rsp)
	jne	.LBB5_21
	movq	-32(%rsp), %rax
	cmpq	$0, -8(%rsp)
	movq	472(%rsp), %r11
	movq	184(%rsp), %rdx
	movq	-48(%rsp), %rcx
	movq	-72(%rsp), %r12
	je	.LBB5_34
.LBB5_23:
	movq	%rax, %rsi
	imulq	%rcx, %rax
	addq	112(%rsp), %rax
	movq	(%rsp), %rcx
	movq	192(%rsp), %r10
	movq	-128(%rsp), %rbx
	shlq	$8, %rsi
	xorl	%r8d, %r8d
	addq	%r14, %rsi
	.p2align	4
.LBB5_24:
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	256(%r9,%rax), %zmm10, %zmm10
	vmulpd	512(%r9,%rax), %zmm11, %zmm11
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vaddpd	(%r10,%rax), %zmm10, %zmm10
	addq	%r12, %rax
	vmovupd	%zmm10, (%rsi,%r8)
	addq	$256, %r8
	cmpq	%r8, %rcx
	jne	.LBB5_24
	jmp	.LBB5_33
.LBB5_25:
	movq	16(%rsp), %rsi
	movq	168(%rsp), %r8
	movq	-24(%rsp), %rax
	movq	24(%rsp), %r9
	cmpq	$0, 160(%rsp)
	movq	-128(%rsp), %rbx
	je	.LBB5_29
	.p2align	4
.LBB5_26:
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	leaq	(%rax,%r12), %r9
	vmulpd	(%rax), %zmm10, %zmm10
	vmulpd	256(%rax), %zmm11, %zmm11
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1792(%rsi)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%rax,%r12), %zmm10, %zmm10
	vmulpd	256(%rax,%r12), %zmm11, %zmm11
	leaq	(%r9,%r12), %rax
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1536(%rsi)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r12,%r9), %zmm10, %zmm10
	vmulpd	256(%r12,%r9), %zmm11, %zmm11
	leaq	(%rax,%r12), %r9
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1280(%rsi)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r12,%rax), %zmm10, %zmm10
	vmulpd	256(%r12,%rax), %zmm11, %zmm11
	leaq	(%r9,%r12), %rax
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1024(%rsi)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r12,%r9), %zmm10, %zmm10
	vmulpd	256(%r12,%r9), %zmm11, %zmm11
	leaq	(%rax,%r12), %r9
	leaq	(%r9,%r12), %r10
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -768(%rsi)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r12,%rax), %zmm10, %zmm10
	vmulpd	256(%r12,%rax), %zmm11, %zmm11
	leaq	(%r12,%r12), %rax
	addq	%r10, %rax
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -512(%rsi)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r12,%r9), %zmm10, %zmm10
	vmulpd	256(%r12,%r9), %zmm11, %zmm11
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -256(%rsi)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r12,%r10), %zmm10, %zmm10
	vmulpd	256(%r12,%r10), %zmm11, %zmm11
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, (%rsi)
	addq	$2048, %rsi
	addq	$-2, %r8
	jne	.LBB5_26
	testb	$1, 144(%rsp)
	je	.LBB5_30
	movq	-128(%rsp), %rbx
	addq	$-1024, %rsi
	movq	%rsi, %r9
.LBB5_29:
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	leaq	(%rax,%r12), %rsi
	vmulpd	(%rax), %zmm10, %zmm10
	vmulpd	256(%rax), %zmm11, %zmm11
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -768(%r9)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%rax,%r12), %zmm10, %zmm10
	vmulpd	256(%rax,%r12), %zmm11, %zmm11
	leaq	(%rsi,%r12), %rax
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -512(%r9)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r12,%rsi), %zmm10, %zmm10
	vmulpd	256(%r12,%rsi), %zmm11, %zmm11
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -256(%r9)
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r12,%rax), %zmm10, %zmm10
	vmulpd	256(%r12,%rax), %zmm11, %zmm11
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, (%r9)
.LBB5_30:
	movq	-32(%rsp), %rax
	cmpq	$0, -8(%rsp)
	je	.LBB5_34
.LBB5_31:
	movq	%rax, %rsi
	imulq	%rcx, %rax
	movq	(%rsp), %rcx
	movq	-24(%rsp), %r9
	movq	32(%rsp), %r10
	movq	-128(%rsp), %rbx
	shlq	$8, %rsi
	xorl	%r8d, %r8d
	addq	%r14, %rsi
	.p2align	4
.LBB5_32:
	vmulpd	12288(%r13,%rbx,8), %zmm8, %zmm10
	vmulpd	12544(%r13,%rbx,8), %zmm8, %zmm11
	vmulpd	(%r9,%rax), %zmm10, %zmm10
	vmulpd	(%r10,%rax), %zmm11, %zmm11
	addq	%r12, %rax
	vaddpd	%zmm10, %zmm9, %zmm10
	vaddpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, (%rsi,%r8)
	addq	$256, %r8
	cmpq	%r8, %rcx
	jne	.LBB5_32
.LBB5_33:
	movq	-48(%rsp), %rcx
.LBB5_34:
	vdivpd	%zmm7, %zmm4, %zmm8
	movq	120(%rsp), %rbp
	movq	128(%rsp), %rsi
	movq	-112(%rsp), %rbx
	movl	$3, %r8d
	xorl	%r15d, %r15d
	jmp	.LBB5_36
	.p2align	4
.LBB5_35:
	incq	%r15
	addq	%r12, %rsi
	addq	%rdx, %r8
	addq	%r12, %rbp
	cmpq	%r15, %r11
	je	.LBB5_5
.LBB5_36:
	movq	-56(%rsp), %rax
	movq	%rcx, %r9
	imulq	%r15, %r9
	addq	%r15, %rax
	shlq	$8, %rax
	cmpq	$7, -64(%rsp)
	vmulpd	(%rbx,%rax), %zmm8, %zmm9
	movq	-128(%rsp), %rax
	vmulpd	%zmm9, %zmm6, %zmm10
	vaddpd	(%rbx,%r9), %zmm10, %zmm10
	vmovupd	%zmm10, (%rbx,%r9)
	vmulpd	7680(%r13,%rax,8), %zmm9, %zmm10
	vmovupd	256(%rbx,%r9), %zmm11
	vsubpd	%zmm10, %zmm11, %zmm10
	vmovupd	512(%rbx,%r9), %zmm11
	vmovupd	%zmm10, 256(%rbx,%r9)
	vmulpd	7936(%r13,%rax,8), %zmm9, %zmm10
	vsubpd	%zmm10, %zmm11, %zmm10
	vmovupd	%zmm10, 512(%rbx,%r9)
	jae	.LBB5_38
	xorl	%eax, %eax
	jmp	.LBB5_45
	.p2align	4
.LBB5_38:
	cmpq	$0, -16(%rsp)
	je	.LBB5_43
	movq	-88(%rsp), %r11
	xorl	%r12d, %r12d
	.p2align	4
.LBB5_40:
	vmulpd	(%r14,%r12), %zmm9, %zmm10
	vmovupd	-3840(%rbp,%r12), %zmm11
	vmovupd	-3328(%rbp,%r12), %zmm12
	vsubpd	%zmm10, %zmm11, %zmm10
	vmovupd	-3584(%rbp,%r12), %zmm11
	vmovupd	%zmm10, -3840(%rbp,%r12)
	vmulpd	256(%r14,%r12), %zmm9, %zmm10
	vsubpd	%zmm10, %zmm11, %zmm10
	vmovupd	%zmm10, -3584(%rbp,%r12)
	vmulpd	512(%r14,%r12), %zmm9, %zmm10
	vsubpd	%zmm10, %zmm12, %zmm10
	vmovupd	%zmm10, -3328(%rbp,%r12)
	vmulpd	768(%r14,%r12), %zmm9, %zmm11
	vmovupd	-3072(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -3072(%rbp,%r12)
	vmulpd	1024(%r14,%r12), %zmm9, %zmm11
	vmovupd	-2816(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -2816(%rbp,%r12)
	vmulpd	1280(%r14,%r12), %zmm9, %zmm11
	vmovupd	-2560(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -2560(%rbp,%r12)
	vmulpd	1536(%r14,%r12), %zmm9, %zmm11
	vmovupd	-2304(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -2304(%rbp,%r12)
	vmulpd	1792(%r14,%r12), %zmm9, %zmm11
	vmovupd	-2048(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -2048(%rbp,%r12)
	vmulpd	2048(%r14,%r12), %zmm9, %zmm11
	vmovupd	-1792(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1792(%rbp,%r12)
	vmulpd	2304(%r14,%r12), %zmm9, %zmm11
	vmovupd	-1536(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1536(%rbp,%r12)
	vmulpd	2560(%r14,%r12), %zmm9, %zmm11
	vmovupd	-1280(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1280(%rbp,%r12)
	vmulpd	2816(%r14,%r12), %zmm9, %zmm11
	vmovupd	-1024(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1024(%rbp,%r12)
	vmulpd	3072(%r14,%r12), %zmm9, %zmm11
	vmovupd	-768(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -768(%rbp,%r12)
	vmulpd	3328(%r14,%r12), %zmm9, %zmm11
	vmovupd	-512(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -512(%rbp,%r12)
	vmulpd	3584(%r14,%r12), %zmm9, %zmm11
	vmovupd	-256(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -256(%rbp,%r12)
	vmulpd	3840(%r14,%r12), %zmm9, %zmm11
	vmovupd	(%rbp,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, (%rbp,%r12)
	addq	$4096, %r12
	addq	$2, %r11
	jne	.LBB5_40
	testb	$1, -80(%rsp)
	movq	472(%rsp), %r11
	jne	.LBB5_44
	movq	-40(%rsp), %rax
	cmpq	$0, -96(%rsp)
	movq	-72(%rsp), %r12
	jne	.LBB5_45
	jmp	.LBB5_35
.LBB5_43:
	xorl	%r12d, %r12d
.LBB5_44:
	vmulpd	(%r14,%r12), %zmm9, %zmm10
	vmovupd	-1792(%rsi,%r12), %zmm11
	vmovupd	-1280(%rsi,%r12), %zmm12
	vsubpd	%zmm10, %zmm11, %zmm10
	vmovupd	-1536(%rsi,%r12), %zmm11
	vmovupd	%zmm10, -1792(%rsi,%r12)
	vmulpd	256(%r14,%r12), %zmm9, %zmm10
	vsubpd	%zmm10, %zmm11, %zmm10
	vmovupd	%zmm10, -1536(%rsi,%r12)
	vmulpd	512(%r14,%r12), %zmm9, %zmm10
	vsubpd	%zmm10, %zmm12, %zmm10
	vmovupd	%zmm10, -1280(%rsi,%r12)
	vmulpd	768(%r14,%r12), %zmm9, %zmm11
	vmovupd	-1024(%rsi,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -1024(%rsi,%r12)
	vmulpd	1024(%r14,%r12), %zmm9, %zmm11
	vmovupd	-768(%rsi,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -768(%rsi,%r12)
	vmulpd	1280(%r14,%r12), %zmm9, %zmm11
	vmovupd	-512(%rsi,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -512(%rsi,%r12)
	vmulpd	1536(%r14,%r12), %zmm9, %zmm11
	vmovupd	-256(%rsi,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, -256(%rsi,%r12)
	vmulpd	1792(%r14,%r12), %zmm9, %zmm11
	vmovupd	(%rsi,%r12), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, (%rsi,%r12)
	movq	-40(%rsp), %rax
	cmpq	$0, -96(%rsp)
	movq	-72(%rsp), %r12
	je	.LBB5_35
.LBB5_45:
	movq	%rax, %r9
	addq	%r8, %rax
	shlq	$8, %r9
	xorl	%r10d, %r10d
	shlq	$8, %rax
	addq	-104(%rsp), %rax
	addq	%r14, %r9
	.p2align	4
.LBB5_46:
	vmulpd	(%r9,%r10), %zmm9, %zmm11
	vmovupd	(%rax,%r10), %zmm10
	vsubpd	%zmm11, %zmm10, %zmm10
	vmovupd	%zmm10, (%rax,%r10)
	addq	$256, %r10
	cmpq	%r10, %rdi
	jne	.LBB5_46
	jmp	.LBB5_35
.LBB5_47:
	movq	%r15, %rax
	imulq	%r14, %rax
	movq	608(%rsp), %rbp
	leaq	(,%r10,8), %r15
	leaq	(%r8,%rax,8), %rax
	leaq	(,%rsi,8), %r8
	leaq	(%rax,%rdx,8), %rax
	leaq	(%rax,%r9,8), %r12
	movq	%rbx, %rax
	imulq	%rcx, %rax
	movq	-128(%rsp), %rcx
	movq	%r12, %r10
	leaq	(%rbp,%rax,8), %rax
	leaq	(%rax,%rdx,8), %rax
	leaq	(%rax,%rcx,8), %r14
	movq	%r8, %rax
	negq	%rax
	testq	%r8, %r8
	leaq	-1(%rdi), %rcx
	cmovnsq	%r8, %rax
	mulq	%rcx
	movq	%r14, %r9
	seto	%sil
	xorl	%edi, %edi
	leaq	(%r14,%rax), %rdx
	subq	%rax, %r9
	cmpq	%r14, %rdx
	setb	%dil
	xorl	%eax, %eax
	cmpq	%r14, %r9
	seta	%al
	testq	%r8, %r8
	cmovsl	%eax, %edi
	movq	%r15, %rax
	negq	%rax
	testq	%r15, %r15
	cmovnsq	%r15, %rax
	mulq	%rcx
	seto	%r9b
	leaq	(%r12,%rax), %rdx
	subq	%rax, %r10
	xorl	%eax, %eax
	cmpq	%r12, %rdx
	setb	%al
	xorl	%edx, %edx
	cmpq	%r12, %r10
	seta	%dl
	testq	%r15, %r15
	cmovsl	%edx, %eax
	xorl	%edx, %edx
	testb	%r9b, %r9b
	jne	.LBB5_60
	testb	%al, %al
	jne	.LBB5_60
	testb	%sil, %sil
	jne	.LBB5_59
	movq	464(%rsp), %r8
	movq	-112(%rsp), %r9
	movq	-120(%rsp), %r11
	testb	%dil, %dil
	movq	672(%rsp), %rdi
	jne	.LBB5_62
	movq	%rcx, %rax
	imulq	536(%rsp), %rax
	movq	520(%rsp), %rdx
	leaq	(%r11,%rdi,8), %r10
	leaq	(%r9,%rdi,8), %rdi
	addq	-104(%rsp), %rax
	imulq	544(%rsp), %rax
	leaq	(%rdx,%rax,8), %rax
	movq	-96(%rsp), %rdx
	leaq	(%rax,%rdx,8), %rax
	movq	-128(%rsp), %rdx
	leaq	(%rax,%r8,8), %rax
	cmpq	%rax, %r12
	movq	%rax, %rsi
	cmovbq	%r12, %rsi
	cmovaq	%r12, %rax
	imulq	624(%rsp), %rcx
	addq	$8, %rax
	addq	%rbx, %rcx
	imulq	632(%rsp), %rcx
	leaq	(%rbp,%rcx,8), %rcx
	leaq	(%rcx,%rdx,8), %rcx
	leaq	(%rcx,%r8,8), %rdx
	cmpq	%rdx, %r14
	movq	%rdx, %rcx
	cmovaq	%r14, %rdx
	cmovbq	%r14, %rcx
	addq	$8, %rdx
	cmpq	%rax, %r11
	setb	%r13b
	cmpq	%r10, %rsi
	setb	%r8b
	cmpq	%rdx, %r11
	setb	-64(%rsp)
	cmpq	%r10, %rcx
	setb	%r10b
	cmpq	%rax, %r9
	setb	-56(%rsp)
	cmpq	%rdi, %rsi
	setb	%r11b
	cmpq	%rdx, %r9
	setb	%r15b
	cmpq	%rdi, %rcx
	setb	%dil
	cmpq	%rdx, %rsi
	setb	%sil
	cmpq	%rax, %rcx
	setb	%al
	xorl	%edx, %edx
	testb	%al, %sil
	jne	.LBB5_59
	andb	%r15b, %dil
	jne	.LBB5_59
	andb	-56(%rsp), %r11b
	jne	.LBB5_59
	andb	%r13b, %r8b
	jne	.LBB5_59
	movq	672(%rsp), %rdi
	movq	-112(%rsp), %r9
	movq	-120(%rsp), %r11
	movq	-80(%rsp), %rax
	movq	-88(%rsp), %rcx
	andb	-64(%rsp), %r10b
	jne	.LBB5_62
	vpbroadcastq	%rax, %zmm0
	movabsq	$.LCPI5_4, %rax
	vpbroadcastq	%rcx, %zmm2
	movabsq	$.LCPI5_5, %rcx
	movabsq	$9223372036854775800, %rdx
	vmovdqa64	(%rax), %zmm1
	vpbroadcastq	(%rcx), %zmm3
	andq	%rdi, %rdx
	xorl	%eax, %eax
	.p2align	4
.LBB5_57:
	vmovupd	(%r9,%rax,8), %zmm4
	vpmullq	%zmm0, %zmm1, %zmm5
	kxnorb	%k0, %k0, %k1
	vscatterqpd	%zmm4, (%r12,%zmm5,8) {%k1}
	vpmullq	%zmm2, %zmm1, %zmm5
	kxnorb	%k0, %k0, %k1
	vpaddq	%zmm3, %zmm1, %zmm1
	vmovupd	(%r11,%rax,8), %zmm4
	addq	$8, %rax
	vscatterqpd	%zmm4, (%r14,%zmm5,8) {%k1}
	cmpq	%rax, %rdx
	jne	.LBB5_57
	movq	672(%rsp), %rdi
	cmpq	%rdx, %rdi
	jne	.LBB5_62
	jmp	.LBB5_68
.LBB5_59:
	movq	672(%rsp), %rdi
	movq	-112(%rsp), %r9
	jmp	.LBB5_61
.LBB5_60:
	movq	%r11, %r9
	movq	672(%rsp), %rdi
.LBB5_61:
	movq	-120(%rsp), %r11
.LBB5_62:
	movq	%rdi, %rcx
	andq	$7, %rcx
	movq	%rdx, %r15
	movq	%rdi, %r10
	je	.LBB5_65
	movq	%rdx, %rax
	imulq	624(%rsp), %rax
	movq	-128(%rsp), %rsi
	movq	464(%rsp), %r8
	movq	%r9, %r14
	movq	520(%rsp), %r9
	movq	%rdx, %r15
	addq	%rbx, %rax
	imulq	632(%rsp), %rax
	leaq	(%rbp,%rax,8), %rax
	leaq	(%rax,%rsi,8), %rax
	leaq	(%rax,%r8,8), %rsi
	movq	-88(%rsp), %rax
	leaq	(,%rax,8), %rdi
	movq	%rdx, %rax
	imulq	536(%rsp), %rax
	addq	-104(%rsp), %rax
	imulq	544(%rsp), %rax
	leaq	(%r9,%rax,8), %rax
	movq	-96(%rsp), %r9
	leaq	(%rax,%r9,8), %rax
	leaq	(%rax,%r8,8), %r8
	movq	-80(%rsp), %rax
	leaq	(,%rax,8), %r9
	.p2align	4
.LBB5_64:
	vmovsd	(%r14,%r15,8), %xmm0
	vmovsd	%xmm0, (%r8)
	addq	%r9, %r8
	vmovsd	(%r11,%r15,8), %xmm0
	incq	%r15
	vmovsd	%xmm0, (%rsi)
	addq	%rdi, %rsi
	decq	%rcx
	jne	.LBB5_64
.LBB5_65:
	subq	%r10, %rdx
	cmpq	$-8, %rdx
	ja	.LBB5_68
	movq	624(%rsp), %r12
	leaq	7(%r15), %r9
	leaq	6(%r15), %r10
	leaq	5(%r15), %rcx
	leaq	3(%r15), %rdi
	leaq	4(%r15), %rsi
	leaq	2(%r15), %r13
	movq	632(%rsp), %rax
	leaq	1(%r15), %r14
	movq	%rbx, %r11
	addq	$56, -120(%rsp)
	addq	$56, -112(%rsp)
	shlq	$6, -88(%rsp)
	shlq	$6, -80(%rsp)
	movq	%rsi, %rdx
	movq	%r13, %r8
	imulq	%r12, %r9
	imulq	%r12, %r10
	imulq	%r12, %rcx
	imulq	%r12, %rdx
	imulq	%r12, %rdi
	imulq	%r12, %r8
	shlq	$3, %rax
	addq	%rbx, %r9
	addq	%rbx, %r10
	addq	%rbx, %rcx
	addq	%rbx, %rdx
	addq	%rbx, %rdi
	addq	%rbx, %r8
	movq	%r15, %rbx
	imulq	%r12, %rbx
	imulq	%r14, %r12
	imulq	%rax, %r9
	imulq	%rax, %r10
	imulq	%rax, %rcx
	imulq	%rax, %rdx
	imulq	%rax, %rdi
	imulq	%rax, %r8
	addq	%r11, %rbx
	addq	%r11, %r12
	leaq	5(%r15), %r11
	imulq	%rax, %rbx
	imulq	%rax, %r12
	movq	-128(%rsp), %rax
	addq	%rbp, %r9
	addq	%rbp, %r10
	addq	%rbp, %rcx
	addq	%rbp, %rdx
	addq	%rbp, %rdi
	addq	%rbp, %r8
	addq	%rbp, %rbx
	addq	%rbp, %r12
	leaq	(%r9,%rax,8), %r9
	leaq	(%r10,%rax,8), %r10
	leaq	(%rcx,%rax,8), %rbp
	movq	%rax, %rcx
	leaq	(%r8,%rcx,8), %r14
	leaq	7(%r15), %r8
	movq	%r9, -56(%rsp)
	leaq	(%rdx,%rax,8), %r9
	leaq	(%rdi,%rax,8), %rax
	leaq	(%rbx,%rcx,8), %rdx
	leaq	(%r12,%rcx,8), %rdi
	movq	536(%rsp), %rcx
	leaq	3(%r15), %r12
	leaq	1(%r15), %rbx
	movq	%r10, -64(%rsp)
	leaq	6(%r15), %r10
	movq	%rax, -72(%rsp)
	movq	%r15, %rax
	imulq	%rcx, %r8
	imulq	%rcx, %r10
	imulq	%rcx, %r11
	imulq	%rcx, %rsi
	imulq	%rcx, %r12
	imulq	%rcx, %r13
	imulq	%rcx, %rax
	imulq	%rcx, %rbx
	movq	-104(%rsp), %rcx
	addq	%rcx, %r8
	addq	%rcx, %r10
	addq	%rcx, %r11
	addq	%rcx, %rsi
	addq	%rcx, %r12
	addq	%rcx, %r13
	addq	%rcx, %rax
	addq	%rcx, %rbx
	movq	544(%rsp), %rcx
	shlq	$3, %rcx
	imulq	%rcx, %r8
	imulq	%rcx, %r10
	imulq	%rcx, %r11
	imulq	%rcx, %rsi
	imulq	%rcx, %r12
	imulq	%rcx, %r13
	imulq	%rcx, %rax
	imulq	%rcx, %rbx
	movq	520(%rsp), %rcx
	addq	%rcx, %r10
	addq	%rcx, %r11
	addq	%rcx, %r8
	addq	%rcx, %rsi
	addq	%rcx, %r12
	addq	%rcx, %r13
	addq	%rcx, %rax
	movq	%r10, -128(%rsp)
	movq	-96(%rsp), %r10
	movq	%r11, -40(%rsp)
	movq	%rbx, %r11
	addq	%rcx, %r11
	leaq	(%r8,%r10,8), %rcx
	movq	-128(%rsp), %r8
	leaq	(%r12,%r10,8), %rbx
	leaq	(%r13,%r10,8), %r12
	leaq	(%rax,%r10,8), %r13
	leaq	(%rsi,%r10,8), %rsi
	leaq	(%r11,%r10,8), %rax
	movq	%rcx, -104(%rsp)
	leaq	(%r8,%r10,8), %rcx
	movq	-40(%rsp), %r8
	leaq	(%r8,%r10,8), %r8
	.p2align	4
.LBB5_67:
	movq	-112(%rsp), %r10
	movq	%rbp, -128(%rsp)
	movq	464(%rsp), %rbp
	movq	-120(%rsp), %r11
	movq	%rax, -16(%rsp)
	movq	%r8, -96(%rsp)
	movq	%r9, -40(%rsp)
	vmovsd	-56(%r10,%r15,8), %xmm0
	vmovsd	%xmm0, (%r13,%rbp,8)
	vmovsd	-56(%r11,%r15,8), %xmm0
	vmovsd	%xmm0, (%rdx,%rbp,8)
	vmovsd	-48(%r10,%r15,8), %xmm0
	vmovsd	%xmm0, (%rax,%rbp,8)
	movq	-72(%rsp), %rax
	vmovsd	-48(%r11,%r15,8), %xmm0
	vmovsd	%xmm0, (%rdi,%rbp,8)
	vmovsd	-40(%r10,%r15,8), %xmm0
	vmovsd	%xmm0, (%r12,%rbp,8)
	vmovsd	-40(%r11,%r15,8), %xmm0
	vmovsd	%xmm0, (%r14,%rbp,8)
	vmovsd	-32(%r10,%r15,8), %xmm0
	vmovsd	%xmm0, (%rbx,%rbp,8)
	vmovsd	-32(%r11,%r15,8), %xmm0
	vmovsd	%xmm0, (%rax,%rbp,8)
	vmovsd	-24(%r10,%r15,8), %xmm0
	vmovsd	%xmm0, (%rsi,%rbp,8)
	vmovsd	-24(%r11,%r15,8), %xmm0
	vmovsd	%xmm0, (%r9,%rbp,8)
	movq	-64(%rsp), %r9
	vmovsd	-16(%r10,%r15,8), %xmm0
	vmovsd	%xmm0, (%r8,%rbp,8)
	movq	-128(%rsp), %r8
	vmovsd	-16(%r11,%r15,8), %xmm0
	vmovsd	%xmm0, (%r8,%rbp,8)
	movq	%rcx, %r8
	vmovsd	-8(%r10,%r15,8), %xmm0
	vmovsd	%xmm0, (%rcx,%rbp,8)
	movq	-104(%rsp), %rcx
	vmovsd	-8(%r11,%r15,8), %xmm0
	vmovsd	%xmm0, (%r9,%rbp,8)
	vmovsd	(%r10,%r15,8), %xmm0
	movq	-56(%rsp), %r10
	vmovsd	%xmm0, (%rcx,%rbp,8)
	vmovsd	(%r11,%r15,8), %xmm0
	movq	-88(%rsp), %r11
	addq	$8, %r15
	addq	%r11, %r9
	addq	%r11, %rax
	addq	%r11, %r14
	addq	%r11, %rdx
	addq	%r11, %rdi
	movq	%r9, -64(%rsp)
	movq	-40(%rsp), %r9
	movq	%rax, -72(%rsp)
	movq	-16(%rsp), %rax
	vmovsd	%xmm0, (%r10,%rbp,8)
	addq	%r11, %r10
	movq	-128(%rsp), %rbp
	movq	%r10, -56(%rsp)
	movq	-80(%rsp), %r10
	addq	%r11, %r9
	addq	%r11, %rbp
	addq	%r10, %rcx
	addq	%r10, %rsi
	addq	%r10, %rbx
	addq	%r10, %r12
	addq	%r10, %r13
	addq	%r10, %rax
	movq	%rcx, -104(%rsp)
	movq	%r8, %rcx
	movq	-96(%rsp), %r8
	addq	%r10, %rcx
	addq	%r10, %r8
	cmpq	%r15, 672(%rsp)
	jne	.LBB5_67
.LBB5_68:
	movq	152(%rsp), %rax
	movq	$0, (%rax)
	xorl	%eax, %eax
	addq	$224, %rsp
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.Lfunc_end5:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9correctedB3v52B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdxx5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedExx, .Lfunc_end5-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9correctedB3v52B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdxx5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedExx

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI6_0:
	.quad	0x4008000000000000
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7crossedB3v53B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxddxxbx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7crossedB3v53B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxddxxbx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7crossedB3v53B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxddxxbx:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$440, %rsp
	.cfi_def_cfa_offset 496
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	1000(%rsp), %r14
	movq	%rdx, 56(%rsp)
	movq	%rsi, %rbx
	movq	968(%rsp), %rsi
	movq	632(%rsp), %rdx
	movq	%rcx, 112(%rsp)
	vmovsd	%xmm1, 296(%rsp)
	vmovapd	%xmm0, %xmm3
	movq	%r9, 128(%rsp)
	movq	%r8, 120(%rsp)
	movq	%rdi, 304(%rsp)
	movq	$0, 352(%rsp)
	movq	$0, 144(%rsp)
	movq	$0, 344(%rsp)
	movq	$0, 216(%rsp)
	movq	$0, 336(%rsp)
	movq	$0, 136(%rsp)
	movq	$0, 208(%rsp)
	movq	$0, 200(%rsp)
	movq	$0, 328(%rsp)
	vmovsd	%xmm0, 16(%rsp)
	testq	%r14, %r14
	leaq	7(%r14), %r15
	setle	%al
	shrq	$3, %r15
	sete	%cl
	orb	%al, %cl
	jne	.LBB6_2
	leaq	12800(%rdx), %rdi
	movq	%r15, %rdx
	shlq	$6, %rdx
	movabsq	$memset, %rax
	xorl	%esi, %esi
	callq	*%rax
	vmovsd	16(%rsp), %xmm3
	movq	632(%rsp), %rdx
	movq	968(%rsp), %rsi
.LBB6_2:
	xorl	%edi, %edi
	testq	%rsi, %rsi
	jle	.LBB6_106
	cmpb	$0, 992(%rsp)
	setne	15(%rsp)
	testq	%r14, %r14
	jle	.LBB6_106
	movq	648(%rsp), %rcx
	movabsq	$9223372036854775776, %r11
	movl	%r15d, %r8d
	andl	$7, %r8d
	movq	504(%rsp), %r13
	movq	%rbx, 32(%rsp)
	xorl	%ebx, %ebx
	leaq	24(%r11), %r10
	movq	%r8, 104(%rsp)
	shll	$6, %r8d
	andq	%r14, %r10
	movq	%r8, 40(%rsp)
	movq	%r15, %r8
	movq	%r14, %r15
	andq	%r11, %r15
	addq	$28, %r11
	movq	%r8, 288(%rsp)
	movq	%r10, 184(%rsp)
	movq	960(%rsp), %r10
	andq	%r14, %r11
	imulq	$400, %rcx, %rax
	imulq	$408, %rcx, %rcx
	leaq	(%rdx,%rcx), %r9
	leaq	192(%rdx,%rcx), %rcx
	leaq	(%rdx,%rax), %r12
	leaq	192(%rdx,%rax), %rbp
	leaq	-8(%r8), %rax
	movq	%rax, 88(%rsp)
	shrq	$3, %rax
	movq	%rcx, 176(%rsp)
	leaq	3840(%rdx), %rcx
	movq	%rax, 96(%rsp)
	incq	%rax
	movq	%rcx, 280(%rsp)
	leaq	7936(%rdx), %rcx
	andq	$-2, %rax
	movq	%rcx, 272(%rsp)
	leaq	7872(%rdx), %rcx
	movq	%rax, 80(%rsp)
	leaq	256(%r13), %rax
	leaq	3(%r8), %rdx
	movq	%rcx, 248(%rsp)
	leaq	2(%r8), %rcx
	xorl	%r8d, %r8d
	movq	%rax, 264(%rsp)
	movq	%rdx, 168(%rsp)
	movq	%rcx, 256(%rsp)
	.p2align	4
.LBB6_5:
	vcvtsi2sd	%rbx, %xmm15, %xmm1
	cmpq	$4, %r14
	jae	.LBB6_7
	xorl	%eax, %eax
	xorl	%edx, %edx
	jmp	.LBB6_16
	.p2align	4
.LBB6_7:
	cmpq	$32, %r14
	jae	.LBB6_9
	xorl	%ecx, %ecx
	xorl	%eax, %eax
	jmp	.LBB6_13
	.p2align	4
.LBB6_9:
	kxorb	%k0, %k0, %k0
	vbroadcastsd	%xmm1, %zmm0
	xorl	%eax, %eax
	kxorb	%k0, %k0, %k2
	kxorb	%k0, %k0, %k3
	kxorb	%k0, %k0, %k1
	.p2align	4
.LBB6_10:
	vcmpeqpd	-192(%rbp,%rax,8), %zmm0, %k4
	vcmpeqpd	(%rbp,%rax,8), %zmm0, %k5
	korb	%k4, %k0, %k0
	vcmpeqpd	-128(%rbp,%rax,8), %zmm0, %k4
	korb	%k5, %k1, %k1
	korb	%k4, %k2, %k2
	vcmpeqpd	-64(%rbp,%rax,8), %zmm0, %k4
	addq	$32, %rax
	korb	%k4, %k3, %k3
	cmpq	%rax, %r15
	jne	.LBB6_10
	korb	%k2, %k0, %k0
	xorl	%eax, %eax
	korb	%k0, %k3, %k0
	kortestb	%k0, %k1
	setne	%al
	cmpq	%r15, %r14
	je	.LBB6_17
	movq	%r15, %rcx
	movq	%r15, %rdx
	testb	$28, %r14b
	je	.LBB6_16
.LBB6_13:
	negb	%al
	vbroadcastsd	%xmm1, %ymm0
	kmovd	%eax, %k0
	.p2align	4
.LBB6_14:
	vcmpeqpd	(%r12,%rcx,8), %ymm0, %k1
	addq	$4, %rcx
	korw	%k1, %k0, %k0
	cmpq	%rcx, %r11
	jne	.LBB6_14
	kmovd	%k0, %ecx
	xorl	%eax, %eax
	movq	%r11, %rdx
	testb	$15, %cl
	setne	%al
	cmpq	%r11, %r14
	je	.LBB6_17
	.p2align	4
.LBB6_16:
	vucomisd	(%r12,%rdx,8), %xmm1
	movq	%rax, %rcx
	movl	$1, %eax
	leaq	1(%rdx), %rdx
	cmovneq	%rcx, %rax
	cmovpq	%rcx, %rax
	cmpq	%rdx, %r14
	jne	.LBB6_16
.LBB6_17:
	movq	%rbx, %rcx
	blsiq	%rbx, %rbx
	cmovaeq	%rsi, %rbx
	testq	%rax, %rax
	jne	.LBB6_19
	addq	%rbx, %rcx
	movq	%rcx, %rbx
	cmpq	%rsi, %rcx
	jl	.LBB6_5
	jmp	.LBB6_107
.LBB6_19:
	vmulsd	%xmm1, %xmm3, %xmm0
	vaddsd	296(%rsp), %xmm0, %xmm0
	leaq	(%rcx,%rcx,2), %rax
	movq	%r8, 24(%rsp)
	movq	%r11, 240(%rsp)
	movq	%r9, 48(%rsp)
	movq	%rcx, 72(%rsp)
	vmovapd	%xmm1, 224(%rsp)
	movq	$0, 360(%rsp)
	addq	%r10, %rax
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	movq	120(%rsp), %rdx
	movq	128(%rsp), %rcx
	movq	136(%rsp), %r8
	movq	504(%rsp), %r9
	leaq	368(%rsp), %rdi
	leaq	360(%rsp), %rsi
	vmovsd	%xmm0, 320(%rsp)
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	movq	%rax, 336(%rsp)
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	976(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	832(%rsp)
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx, %rax
	vzeroupper
	callq	*%rax
	addq	$336, %rsp
	.cfi_adjust_cfa_offset -336
	cmpl	$-2, %eax
	je	.LBB6_21
	testl	%eax, %eax
	jne	.LBB6_109
.LBB6_21:
	cmpq	$0, 288(%rsp)
	movq	632(%rsp), %rdi
	je	.LBB6_24
	movq	576(%rsp), %r9
	movq	504(%rsp), %r10
	leaq	7(%r14), %rax
	cmpq	$64, %rax
	jae	.LBB6_25
	movq	40(%rsp), %r8
	xorl	%ecx, %ecx
	jmp	.LBB6_32
.LBB6_24:
	movq	504(%rsp), %rdx
	movq	576(%rsp), %rcx
	leaq	160(%rsp), %rdi
	leaq	152(%rsp), %rsi
	movq	%r14, %r8
	movq	$0, 160(%rsp)
	movq	$0, 152(%rsp)
	callq	*56(%rsp)
	vmovq	16(%rsp), %xmm2
	cltq
	movq	632(%rsp), %r10
	movq	648(%rsp), %r11
	movq	624(%rsp), %r9
	orq	%rax, 24(%rsp)
	cmpq	$1, %rbx
	jg	.LBB6_62
	jmp	.LBB6_64
.LBB6_25:
	cmpq	$0, 96(%rsp)
	movq	40(%rsp), %r8
	je	.LBB6_29
	movq	80(%rsp), %rax
	xorl	%ecx, %ecx
	.p2align	4
.LBB6_27:
	vmovups	(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, (%rdx,%rcx,8)
	vmovups	64(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 64(%rdx,%rcx,8)
	vmovups	128(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 128(%rdx,%rcx,8)
	vmovups	192(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 192(%rdx,%rcx,8)
	vmovups	256(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 256(%rdx,%rcx,8)
	vmovups	320(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 320(%rdx,%rcx,8)
	vmovups	384(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 384(%rdx,%rcx,8)
	vmovups	448(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 448(%rdx,%rcx,8)
	vmovups	512(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 512(%rdx,%rcx,8)
	vmovups	576(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 576(%rdx,%rcx,8)
	vmovups	640(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 640(%rdx,%rcx,8)
	vmovups	704(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 704(%rdx,%rcx,8)
	vmovups	768(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 768(%rdx,%rcx,8)
	vmovups	832(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 832(%rdx,%rcx,8)
	vmovups	896(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovups	%zmm0, 896(%rdx,%rcx,8)
	vmovupd	960(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rdx
	shlq	$8, %rdx
	addq	%r10, %rdx
	addq	$-2, %rax
	vmovupd	%zmm0, 960(%rdx,%rcx,8)
	leaq	128(%rcx), %rcx
	jne	.LBB6_27
	testb	$8, 88(%rsp)
	je	.LBB6_30
	jmp	.LBB6_31
.LBB6_29:
	xorl	%ecx, %ecx
.LBB6_30:
	vmovups	(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rax
	shlq	$8, %rax
	addq	%r10, %rax
	vmovups	%zmm0, (%rax,%rcx,8)
	vmovups	64(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rax
	shlq	$8, %rax
	addq	%r10, %rax
	vmovups	%zmm0, 64(%rax,%rcx,8)
	vmovups	128(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rax
	shlq	$8, %rax
	addq	%r10, %rax
	vmovups	%zmm0, 128(%rax,%rcx,8)
	vmovups	192(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rax
	shlq	$8, %rax
	addq	%r10, %rax
	vmovups	%zmm0, 192(%rax,%rcx,8)
	vmovups	256(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rax
	shlq	$8, %rax
	addq	%r10, %rax
	vmovups	%zmm0, 256(%rax,%rcx,8)
	vmovups	320(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rax
	shlq	$8, %rax
	addq	%r10, %rax
	vmovups	%zmm0, 320(%rax,%rcx,8)
	vmovups	384(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rax
	shlq	$8, %rax
	addq	%r10, %rax
	vmovups	%zmm0, 384(%rax,%rcx,8)
	vmovupd	448(%rdi,%rcx,8), %zmm0
	movq	8(%r9), %rax
	shlq	$8, %rax
	addq	%r10, %rax
	vmovupd	%zmm0, 448(%rax,%rcx,8)
	addq	$64, %rcx
.LBB6_31:
	cmpq	$0, 104(%rsp)
	je	.LBB6_34
.LBB6_32:
	leaq	(%r10,%rcx,8), %rax
	leaq	(%rdi,%rcx,8), %rcx
	xorl	%edx, %edx
	.p2align	4
.LBB6_33:
	vmovupd	(%rcx,%rdx), %zmm0
	movq	8(%r9), %rsi
	shlq	$8, %rsi
	addq	%rax, %rsi
	vmovupd	%zmm0, (%rdx,%rsi)
	addq	$64, %rdx
	cmpq	%rdx, %r8
	jne	.LBB6_33
.LBB6_34:
	movq	168(%rsp), %rcx
	movl	$256, %eax
	.p2align	4
.LBB6_35:
	vmovupd	(%rdi,%rax), %zmm0
	movq	8(%r9), %rdx
	decq	%rcx
	shlq	$8, %rdx
	addq	%r10, %rdx
	vmovupd	%zmm0, (%rax,%rdx)
	addq	$64, %rax
	cmpq	$3, %rcx
	jg	.LBB6_35
	leaq	160(%rsp), %rdi
	leaq	152(%rsp), %rsi
	movq	$0, 160(%rsp)
	movq	$0, 152(%rsp)
	movq	%r10, %rdx
	movq	%r9, %rcx
	movq	%r14, %r8
	vzeroupper
	callq	*56(%rsp)
	leaq	7(%r14), %rcx
	movl	%eax, 64(%rsp)
	cmpq	$64, %rcx
	jae	.LBB6_38
	vmovq	16(%rsp), %xmm2
	movq	632(%rsp), %r10
	movq	648(%rsp), %rax
	movq	40(%rsp), %r8
	movq	624(%rsp), %r9
	movq	576(%rsp), %r11
	xorl	%edx, %edx
	jmp	.LBB6_45
.LBB6_38:
	vmovq	16(%rsp), %xmm2
	cmpq	$0, 96(%rsp)
	movq	648(%rsp), %rax
	movq	624(%rsp), %r9
	je	.LBB6_42
	movq	80(%rsp), %rcx
	movq	632(%rsp), %r10
	movq	576(%rsp), %rdi
	movq	504(%rsp), %r11
	xorl	%edx, %edx
	.p2align	4
.LBB6_40:
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 3584(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	64(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 3648(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	128(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 3712(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	192(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 3776(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	256(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 3840(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	320(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 3904(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	384(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 3968(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	448(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 4032(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	512(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 4096(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	576(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 4160(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	640(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 4224(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	704(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 4288(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	768(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 4352(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	832(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 4416(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	vmovups	896(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 4480(%r10,%rdx,8)
	movq	16(%rdi), %rsi
	shlq	$8, %rsi
	addq	%r11, %rsi
	addq	$-2, %rcx
	vmovupd	960(%rsi,%rdx,8), %zmm0
	vmovupd	%zmm0, 4544(%r10,%rdx,8)
	leaq	128(%rdx), %rdx
	jne	.LBB6_40
	testb	$8, 88(%rsp)
	movq	40(%rsp), %r8
	je	.LBB6_43
	jmp	.LBB6_44
.LBB6_42:
	movq	632(%rsp), %r10
	movq	40(%rsp), %r8
	movq	504(%rsp), %r11
	xorl	%edx, %edx
.LBB6_43:
	movq	576(%rsp), %rsi
	movq	16(%rsi), %rcx
	shlq	$8, %rcx
	addq	%r11, %rcx
	vmovups	(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 3584(%r10,%rdx,8)
	movq	16(%rsi), %rcx
	shlq	$8, %rcx
	addq	%r11, %rcx
	vmovups	64(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 3648(%r10,%rdx,8)
	movq	16(%rsi), %rcx
	shlq	$8, %rcx
	addq	%r11, %rcx
	vmovups	128(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 3712(%r10,%rdx,8)
	movq	16(%rsi), %rcx
	shlq	$8, %rcx
	addq	%r11, %rcx
	vmovups	192(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 3776(%r10,%rdx,8)
	movq	16(%rsi), %rcx
	shlq	$8, %rcx
	addq	%r11, %rcx
	vmovups	256(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 3840(%r10,%rdx,8)
	movq	16(%rsi), %rcx
	shlq	$8, %rcx
	addq	%r11, %rcx
	vmovups	320(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 3904(%r10,%rdx,8)
	movq	16(%rsi), %rcx
	shlq	$8, %rcx
	addq	%r11, %rcx
	vmovups	384(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 3968(%r10,%rdx,8)
	movq	16(%rsi), %rcx
	shlq	$8, %rcx
	addq	%r11, %rcx
	vmovupd	448(%rcx,%rdx,8), %zmm0
	vmovupd	%zmm0, 4032(%r10,%rdx,8)
	addq	$64, %rdx
.LBB6_44:
	cmpq	$0, 104(%rsp)
	movq	576(%rsp), %r11
	je	.LBB6_47
.LBB6_45:
	movq	504(%rsp), %rsi
	leaq	3584(%r10,%rdx,8), %rcx
	leaq	(%rsi,%rdx,8), %rdx
	xorl	%esi, %esi
	.p2align	4
.LBB6_46:
	movq	16(%r11), %rdi
	shlq	$8, %rdi
	addq	%rdx, %rdi
	vmovupd	(%rsi,%rdi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %r8
	jne	.LBB6_46
.LBB6_47:
	movq	168(%rsp), %rcx
	movq	264(%rsp), %rdx
	movq	280(%rsp), %rsi
	.p2align	4
.LBB6_48:
	movq	16(%r11), %rdi
	decq	%rcx
	shlq	$8, %rdi
	vmovupd	(%rdx,%rdi), %zmm0
	addq	$64, %rdx
	vmovupd	%zmm0, (%rsi)
	addq	$64, %rsi
	cmpq	$3, %rcx
	jg	.LBB6_48
	leaq	7(%r14), %rcx
	cmpq	$64, %rcx
	jae	.LBB6_51
	movq	%rax, %r11
	movl	64(%rsp), %eax
	xorl	%ecx, %ecx
	movabsq	$.LCPI6_0, %rdi
	jmp	.LBB6_58
.LBB6_51:
	cmpq	$0, 96(%rsp)
	movq	248(%rsp), %rsi
	movabsq	$.LCPI6_0, %rdi
	movq	%rax, %r11
	je	.LBB6_55
	movq	80(%rsp), %rdx
	xorl	%ecx, %ecx
	.p2align	4
.LBB6_53:
	vbroadcastsd	(%rdi), %zmm0
	vmulpd	-7360(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -1216(%rsi,%rcx,8)
	vmulpd	-7296(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -1152(%rsi,%rcx,8)
	vmulpd	-7232(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -1088(%rsi,%rcx,8)
	vmulpd	-7168(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -1024(%rsi,%rcx,8)
	vmulpd	-7104(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -960(%rsi,%rcx,8)
	vmulpd	-7040(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -896(%rsi,%rcx,8)
	vmulpd	-6976(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -832(%rsi,%rcx,8)
	vmulpd	-6912(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -768(%rsi,%rcx,8)
	vmulpd	-6848(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -704(%rsi,%rcx,8)
	vmulpd	-6784(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -640(%rsi,%rcx,8)
	vmulpd	-6720(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -576(%rsi,%rcx,8)
	vmulpd	-6656(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -512(%rsi,%rcx,8)
	vmulpd	-6592(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -448(%rsi,%rcx,8)
	vmulpd	-5824(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -192(%rsi,%rcx,8)
	vmulpd	-6528(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -384(%rsi,%rcx,8)
	vmulpd	-5760(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -128(%rsi,%rcx,8)
	vmulpd	-6464(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -320(%rsi,%rcx,8)
	vmulpd	-5696(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -64(%rsi,%rcx,8)
	vmulpd	-6400(%rsi,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -256(%rsi,%rcx,8)
	vmulpd	-5632(%rsi,%rcx,8), %zmm0, %zmm0
	vsqrtpd	%zmm0, %zmm0
	vmovupd	%zmm0, (%rsi,%rcx,8)
	subq	$-128, %rcx
	addq	$-2, %rdx
	jne	.LBB6_53
	testb	$8, 88(%rsp)
	je	.LBB6_56
	jmp	.LBB6_57
.LBB6_55:
	xorl	%ecx, %ecx
.LBB6_56:
	vbroadcastsd	(%rdi), %zmm0
	vmulpd	512(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6656(%r10,%rcx,8)
	vmulpd	576(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6720(%r10,%rcx,8)
	vmulpd	640(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6784(%r10,%rcx,8)
	vmulpd	704(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6848(%r10,%rcx,8)
	vmulpd	768(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6912(%r10,%rcx,8)
	vmulpd	1536(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7168(%r10,%rcx,8)
	vmulpd	832(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 6976(%r10,%rcx,8)
	vmulpd	1600(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7232(%r10,%rcx,8)
	vmulpd	896(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7040(%r10,%rcx,8)
	vmulpd	1664(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7296(%r10,%rcx,8)
	vmulpd	960(%r10,%rcx,8), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, 7104(%r10,%rcx,8)
	vmulpd	1728(%r10,%rcx,8), %zmm0, %zmm0
	vsqrtpd	%zmm0, %zmm0
	vmovupd	%zmm0, 7360(%r10,%rcx,8)
	addq	$64, %rcx
.LBB6_57:
	cmpq	$0, 104(%rsp)
	movl	64(%rsp), %eax
	je	.LBB6_60
.LBB6_58:
	leaq	6912(%r10,%rcx,8), %rcx
	xorl	%edx, %edx
	.p2align	4
.LBB6_59:
	vbroadcastsd	(%rdi), %zmm0
	vmulpd	-6400(%rcx,%rdx), %zmm0, %zmm1
	vsqrtpd	%zmm1, %zmm1
	vmovupd	%zmm1, -256(%rcx,%rdx)
	vmulpd	-5632(%rcx,%rdx), %zmm0, %zmm0
	vsqrtpd	%zmm0, %zmm0
	vmovupd	%zmm0, (%rcx,%rdx)
	addq	$64, %rdx
	cmpq	%rdx, %r8
	jne	.LBB6_59
.LBB6_60:
	movq	24(%rsp), %rdx
	cltq
	movq	272(%rsp), %rcx
	orq	%rax, %rdx
	movq	256(%rsp), %rax
	movq	%rdx, 24(%rsp)
	cmpq	$2, %rbx
	jl	.LBB6_64
	.p2align	4
.LBB6_61:
	vmovupd	-4352(%rcx), %zmm0
	vmovupd	-4096(%rcx), %zmm1
	decq	%rax
	vmovupd	%zmm0, -256(%rcx)
	vmovupd	%zmm1, (%rcx)
	addq	$64, %rcx
	cmpq	$2, %rax
	jg	.LBB6_61
.LBB6_62:
	movq	$0, 144(%rsp)
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	movq	%r9, %rax
	movq	64(%rsp), %rdx
	movq	120(%rsp), %rcx
	movq	128(%rsp), %r8
	movq	136(%rsp), %r9
	leaq	152(%rsp), %rdi
	leaq	352(%rsp), %rsi
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	$28
	.cfi_adjust_cfa_offset 8
	pushq	$0
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r11
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	696(%rsp)
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v27B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_2924Literal_5bint_5d_2828_29x, %rax
	vzeroupper
	callq	*%rax
	addq	$208, %rsp
	.cfi_adjust_cfa_offset -208
	testl	%eax, %eax
	jne	.LBB6_109
	vmovq	16(%rsp), %xmm2
	movq	24(%rsp), %rax
	movq	632(%rsp), %r10
	movq	648(%rsp), %r11
	movq	624(%rsp), %r9
	orq	144(%rsp), %rax
	movq	%rax, 24(%rsp)
.LBB6_64:
	movq	600(%rsp), %rdx
	movq	608(%rsp), %rcx
	movq	616(%rsp), %r8
	movq	$0, 216(%rsp)
	leaq	216(%rsp), %rdi
	leaq	336(%rsp), %rsi
	vmovdqa	%xmm2, %xmm0
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	pushq	88(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r11
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6wantedB3v46B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx, %rax
	vzeroupper
	callq	*%rax
	addq	$64, %rsp
	.cfi_adjust_cfa_offset -64
	cmpl	$-2, %eax
	je	.LBB6_66
	testl	%eax, %eax
	jne	.LBB6_109
.LBB6_66:
	cmpq	$8, %r14
	jae	.LBB6_68
	vmovsd	16(%rsp), %xmm3
	vmovapd	224(%rsp), %xmm9
	movq	968(%rsp), %rsi
	movq	632(%rsp), %r10
	movq	648(%rsp), %r11
	movq	48(%rsp), %r9
	movq	616(%rsp), %rbx
	xorl	%eax, %eax
	xorl	%ecx, %ecx
	jmp	.LBB6_102
.LBB6_68:
	vmovapd	224(%rsp), %xmm9
	movq	968(%rsp), %rsi
	movq	632(%rsp), %r10
	movq	648(%rsp), %r11
	movq	48(%rsp), %r9
	movq	616(%rsp), %rbx
	vbroadcastsd	%xmm9, %zmm0
	cmpq	$32, %r14
	jae	.LBB6_70
	vmovsd	16(%rsp), %xmm3
	xorl	%edx, %edx
	xorl	%eax, %eax
	jmp	.LBB6_75
.LBB6_70:
	movq	176(%rsp), %rcx
	vxorpd	%xmm1, %xmm1, %xmm1
	xorl	%eax, %eax
	vpxor	%xmm2, %xmm2, %xmm2
	vxorpd	%xmm3, %xmm3, %xmm3
	vpxor	%xmm4, %xmm4, %xmm4
	.p2align	4
.LBB6_71:
	vcmpeqpd	-192(%rbp,%rax,8), %zmm0, %k3
	vcmpeqpd	-128(%rbp,%rax,8), %zmm0, %k4
	vcmpeqpd	-64(%rbp,%rax,8), %zmm0, %k2
	vcmpeqpd	(%rbp,%rax,8), %zmm0, %k1
	vmovupd	-192(%rcx,%rax,8), %zmm5 {%k3} {z}
	vmovupd	-128(%rcx,%rax,8), %zmm6 {%k4} {z}
	vmovupd	-64(%rcx,%rax,8), %zmm7 {%k2} {z}
	vmovupd	(%rcx,%rax,8), %zmm8 {%k1} {z}
	addq	$32, %rax
	vcvttpd2qq	%zmm5, %zmm5
	vcvttpd2qq	%zmm6, %zmm6
	vcvttpd2qq	%zmm7, %zmm7
	vcvttpd2qq	%zmm8, %zmm8
	vpmaxsq	%zmm1, %zmm5, %zmm1 {%k3}
	vpmaxsq	%zmm2, %zmm6, %zmm2 {%k4}
	vpmaxsq	%zmm3, %zmm7, %zmm3 {%k2}
	vpmaxsq	%zmm4, %zmm8, %zmm4 {%k1}
	cmpq	%rax, %r15
	jne	.LBB6_71
	vpmaxsq	%zmm2, %zmm1, %zmm1
	vpmaxsq	%zmm4, %zmm3, %zmm3
	vpmaxsq	%zmm3, %zmm1, %zmm1
	vextracti64x4	$1, %zmm1, %ymm2
	vpmaxsq	%zmm2, %zmm1, %zmm1
	vextracti128	$1, %ymm1, %xmm2
	vpmaxsq	%xmm2, %xmm1, %xmm1
	vpshufd	$238, %xmm1, %xmm2
	vpmaxsq	%xmm2, %xmm1, %xmm1
	vmovq	%xmm1, %rax
	cmpq	%r15, %r14
	jne	.LBB6_74
	vmovsd	16(%rsp), %xmm3
	jmp	.LBB6_78
.LBB6_74:
	vmovsd	16(%rsp), %xmm3
	movq	%r15, %rdx
	movq	%r15, %rcx
	testb	$24, %r14b
	je	.LBB6_102
.LBB6_75:
	movq	184(%rsp), %rcx
	vpbroadcastq	%rax, %zmm1
	.p2align	4
.LBB6_76:
	vcmpeqpd	(%r12,%rdx,8), %zmm0, %k1
	vmovupd	(%r9,%rdx,8), %zmm2 {%k1} {z}
	addq	$8, %rdx
	vcvttpd2qq	%zmm2, %zmm2
	vpmaxsq	%zmm1, %zmm2, %zmm1 {%k1}
	cmpq	%rdx, %rcx
	jne	.LBB6_76
	vextracti64x4	$1, %zmm1, %ymm0
	vpmaxsq	%zmm0, %zmm1, %zmm0
	vextracti128	$1, %ymm0, %xmm1
	vpmaxsq	%xmm1, %xmm0, %xmm0
	vpshufd	$238, %xmm0, %xmm1
	vpmaxsq	%xmm1, %xmm0, %xmm0
	vmovq	%xmm0, %rax
	jmp	.LBB6_101
.LBB6_78:
	testq	%rax, %rax
	jle	.LBB6_99
	vbroadcastsd	%xmm9, %zmm9
	movq	%r15, 192(%rsp)
	vmovupd	%zmm9, 368(%rsp)
	jmp	.LBB6_82
.LBB6_80:
	vmovsd	16(%rsp), %xmm3
	.p2align	4
.LBB6_81:
	testq	%rax, %rax
	jle	.LBB6_100
.LBB6_82:
	movq	$0, 136(%rsp)
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	vmovsd	320(%rsp), %xmm1
	movq	64(%rsp), %rdx
	movq	120(%rsp), %rcx
	movq	128(%rsp), %r8
	movq	136(%rsp), %r9
	leaq	144(%rsp), %rdi
	leaq	216(%rsp), %rsi
	vmovapd	%xmm3, %xmm0
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	movq	%rax, 80(%rsp)
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	96(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	352(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	992(%rsp)
	.cfi_adjust_cfa_offset 8
	movq	912(%rsp), %r14
	movq	920(%rsp), %r13
	pushq	%r13
	.cfi_adjust_cfa_offset 8
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	%r11
	.cfi_adjust_cfa_offset 8
	movq	920(%rsp), %rax
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	920(%rsp), %rax
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	movq	920(%rsp), %rax
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	movq	920(%rsp), %rax
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	920(%rsp)
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9attemptedB3v48B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxddx, %rax
	movq	%rbx, %r13
	movq	%r10, %rbx
	movq	%r11, %r15
	vzeroupper
	callq	*%rax
	addq	$432, %rsp
	.cfi_adjust_cfa_offset -432
	testl	%eax, %eax
	jne	.LBB6_110
	movq	64(%rsp), %r10
	movq	24(%rsp), %rax
	movzbl	15(%rsp), %ecx
	movq	600(%rsp), %rdx
	movq	624(%rsp), %r9
	movq	$0, 200(%rsp)
	leaq	200(%rsp), %rdi
	leaq	328(%rsp), %rsi
	movq	%r13, %r8
	orq	136(%rsp), %rax
	vcvtsi2sd	%r10, %xmm15, %xmm0
	vmulsd	16(%rsp), %xmm0, %xmm0
	movq	%rax, 24(%rsp)
	xorl	%eax, %eax
	movb	%cl, %al
	movq	608(%rsp), %rcx
	pushq	1000(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	88(%rsp)
	.cfi_adjust_cfa_offset 8
	movq	%r10, %r13
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	1016(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	1016(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	%r15
	.cfi_adjust_cfa_offset 8
	pushq	784(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7carriedB3v55B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxdxxbx, %rax
	callq	*%rax
	addq	$160, %rsp
	.cfi_adjust_cfa_offset -160
	testl	%eax, %eax
	jne	.LBB6_109
	movq	1000(%rsp), %r14
	cmpq	$8, %r14
	jae	.LBB6_86
	vmovsd	16(%rsp), %xmm3
	vmovapd	224(%rsp), %xmm8
	movq	968(%rsp), %rsi
	movq	632(%rsp), %r10
	movq	648(%rsp), %r11
	movq	192(%rsp), %r15
	movq	48(%rsp), %r9
	movq	616(%rsp), %rbx
	xorl	%eax, %eax
	xorl	%ecx, %ecx
	jmp	.LBB6_96
	.p2align	4
.LBB6_86:
	vmovapd	224(%rsp), %xmm8
	vmovupd	368(%rsp), %zmm9
	movq	968(%rsp), %rsi
	movq	632(%rsp), %r10
	movq	648(%rsp), %r11
	movq	192(%rsp), %r15
	movq	48(%rsp), %r9
	movq	616(%rsp), %rbx
	cmpq	$32, %r14
	jae	.LBB6_88
	vmovsd	16(%rsp), %xmm3
	xorl	%edx, %edx
	xorl	%eax, %eax
	jmp	.LBB6_92
	.p2align	4
.LBB6_88:
	movq	176(%rsp), %rcx
	vxorpd	%xmm0, %xmm0, %xmm0
	xorl	%eax, %eax
	vxorpd	%xmm1, %xmm1, %xmm1
	vpxor	%xmm2, %xmm2, %xmm2
	vxorpd	%xmm3, %xmm3, %xmm3
	.p2align	4
.LBB6_89:
	vcmpeqpd	-192(%rbp,%rax,8), %zmm9, %k3
	vcmpeqpd	-128(%rbp,%rax,8), %zmm9, %k4
	vcmpeqpd	-64(%rbp,%rax,8), %zmm9, %k2
	vcmpeqpd	(%rbp,%rax,8), %zmm9, %k1
	vmovupd	-192(%rcx,%rax,8), %zmm4 {%k3} {z}
	vmovupd	-128(%rcx,%rax,8), %zmm5 {%k4} {z}
	vmovupd	-64(%rcx,%rax,8), %zmm6 {%k2} {z}
	vmovupd	(%rcx,%rax,8), %zmm7 {%k1} {z}
	addq	$32, %rax
	vcvttpd2qq	%zmm4, %zmm4
	vcvttpd2qq	%zmm5, %zmm5
	vcvttpd2qq	%zmm6, %zmm6
	vcvttpd2qq	%zmm7, %zmm7
	vpmaxsq	%zmm0, %zmm4, %zmm0 {%k3}
	vpmaxsq	%zmm1, %zmm5, %zmm1 {%k4}
	vpmaxsq	%zmm2, %zmm6, %zmm2 {%k2}
	vpmaxsq	%zmm3, %zmm7, %zmm3 {%k1}
	cmpq	%rax, %r15
	jne	.LBB6_89
	vpmaxsq	%zmm1, %zmm0, %zmm0
	vpmaxsq	%zmm3, %zmm2, %zmm2
	vpmaxsq	%zmm2, %zmm0, %zmm0
	vextracti64x4	$1, %zmm0, %ymm1
	vpmaxsq	%zmm1, %zmm0, %zmm0
	vextracti128	$1, %ymm0, %xmm1
	vpmaxsq	%xmm1, %xmm0, %xmm0
	vpshufd	$238, %xmm0, %xmm1
	vpmaxsq	%xmm1, %xmm0, %xmm0
	vmovq	%xmm0, %rax
	cmpq	%r15, %r14
	je	.LBB6_80
	vmovsd	16(%rsp), %xmm3
	movq	%r15, %rdx
	movq	%r15, %rcx
	testb	$24, %r14b
	je	.LBB6_96
.LBB6_92:
	movq	184(%rsp), %rcx
	vpbroadcastq	%rax, %zmm0
	.p2align	4
.LBB6_93:
	vcmpeqpd	(%r12,%rdx,8), %zmm9, %k1
	vmovupd	(%r9,%rdx,8), %zmm1 {%k1} {z}
	addq	$8, %rdx
	vcvttpd2qq	%zmm1, %zmm1
	vpmaxsq	%zmm0, %zmm1, %zmm0 {%k1}
	cmpq	%rdx, %rcx
	jne	.LBB6_93
	vextracti64x4	$1, %zmm0, %ymm1
	vpmaxsq	%zmm1, %zmm0, %zmm0
	vextracti128	$1, %ymm0, %xmm1
	vpmaxsq	%xmm1, %xmm0, %xmm0
	vpshufd	$238, %xmm0, %xmm1
	vpmaxsq	%xmm1, %xmm0, %xmm0
	vmovq	%xmm0, %rax
	.p2align	4
.LBB6_95:
	cmpq	%rcx, %r14
	je	.LBB6_81
.LBB6_96:
	vmovsd	(%r12,%rcx,8), %xmm0
	vucomisd	%xmm8, %xmm0
	jne	.LBB6_98
	jp	.LBB6_98
	vcvttsd2si	(%r9,%rcx,8), %rdx
	cmpq	%rax, %rdx
	cmovgq	%rdx, %rax
.LBB6_98:
	incq	%rcx
	jmp	.LBB6_95
.LBB6_99:
	movq	%rax, %r13
.LBB6_100:
	movq	%r13, %rbx
	addq	72(%rsp), %rbx
	movq	960(%rsp), %r10
	movq	240(%rsp), %r11
	movq	24(%rsp), %r8
	movl	$0, %edi
	cmpq	%rsi, %rbx
	jl	.LBB6_5
	jmp	.LBB6_107
	.p2align	4
.LBB6_101:
	cmpq	%rcx, %r14
	je	.LBB6_78
.LBB6_102:
	vmovsd	(%r12,%rcx,8), %xmm0
	vucomisd	%xmm9, %xmm0
	jne	.LBB6_104
	jp	.LBB6_104
	vcvttsd2si	(%r9,%rcx,8), %rdx
	cmpq	%rax, %rdx
	cmovgq	%rdx, %rax
.LBB6_104:
	incq	%rcx
	jmp	.LBB6_101
.LBB6_106:
	xorl	%r8d, %r8d
.LBB6_107:
	movq	304(%rsp), %rax
	movq	%r8, (%rax)
.LBB6_108:
	movl	%edi, %eax
	addq	$440, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.LBB6_109:
	.cfi_def_cfa_offset 496
	movq	32(%rsp), %rcx
	movq	$0, (%rcx)
	jmp	.LBB6_111
.LBB6_110:
	movq	208(%rsp), %rcx
	movq	32(%rsp), %rdx
	movq	%rcx, (%rdx)
.LBB6_111:
	movl	%eax, %edi
	jmp	.LBB6_108
.Lfunc_end6:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7crossedB3v53B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxddxxbx, .Lfunc_end6-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7crossedB3v53B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxddxxbx
	.cfi_endproc

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI7_0:
	.quad	0x3fe0000000000000
.LCPI7_1:
	.quad	0x7fffffffffffffff
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v27B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_2924Literal_5bint_5d_2828_29x
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v27B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_2924Literal_5bint_5d_2828_29x,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v27B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_2924Literal_5bint_5d_2828_29x:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$56, %rsp
	.cfi_def_cfa_offset 112
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	304(%rsp), %r8
	movq	%rdx, %r9
	movq	192(%rsp), %r14
	movq	120(%rsp), %r15
	movq	%rdi, %rbx
	movq	$0, 32(%rsp)
	movq	$0, 24(%rsp)
	leaq	7(%r8), %rdx
	movq	%rdx, %r13
	shrq	$3, %r13
	testq	%r8, %r8
	setle	%al
	testq	%r13, %r13
	sete	%cl
	orb	%al, %cl
	je	.LBB7_1
	leaq	8(%rsp), %rdi
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r14, %rcx
	movq	%r8, %r13
	movq	%r9, %r12
	callq	*%r9
	leaq	32(%rsp), %rdi
	leaq	24(%rsp), %rsi
	movl	%eax, %ebp
	movq	%r15, %rdx
	movq	%r14, %rcx
	movq	%r13, %r8
	callq	*%r12
	jmp	.LBB7_33
.LBB7_1:
	movq	%rbx, 48(%rsp)
	movq	248(%rsp), %rbx
	movl	%r13d, %r12d
	andl	$7, %r12d
	movq	%rdx, 40(%rsp)
	cmpq	$64, %rdx
	jae	.LBB7_3
	xorl	%ecx, %ecx
	jmp	.LBB7_6
.LBB7_3:
	movq	%rdx, %rax
	shrq	$6, %rax
	xorl	%ecx, %ecx
	shlq	$3, %rax
	negq	%rax
	.p2align	4
.LBB7_4:
	vmovupd	(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6656(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, (%rdx,%rcx,8)
	vmovups	7680(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%rcx,8)
	vmovupd	64(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6720(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 64(%rdx,%rcx,8)
	vmovups	7744(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%rcx,8)
	vmovupd	128(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6784(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 128(%rdx,%rcx,8)
	vmovups	7808(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%rcx,8)
	vmovupd	192(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6848(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 192(%rdx,%rcx,8)
	vmovups	7872(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8384(%rbx,%rcx,8)
	vmovupd	256(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6912(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 256(%rdx,%rcx,8)
	vmovups	7936(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8448(%rbx,%rcx,8)
	vmovupd	320(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6976(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 320(%rdx,%rcx,8)
	vmovups	8000(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8512(%rbx,%rcx,8)
	vmovupd	384(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	7040(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 384(%rdx,%rcx,8)
	vmovups	8064(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8576(%rbx,%rcx,8)
	vmovupd	448(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	7104(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	addq	$8, %rax
	vmovupd	%zmm0, 448(%rdx,%rcx,8)
	vmovupd	8128(%rbx,%rcx,8), %zmm0
	vmovupd	%zmm0, 8640(%rbx,%rcx,8)
	leaq	64(%rcx), %rcx
	jne	.LBB7_4
	testq	%r12, %r12
	je	.LBB7_8
.LBB7_6:
	leaq	8192(%rbx,%rcx,8), %rax
	leaq	(%r15,%rcx,8), %rcx
	movl	%r12d, %edx
	shll	$6, %edx
	xorl	%esi, %esi
	.p2align	4
.LBB7_7:
	vmovupd	-8192(%rax,%rsi), %zmm0
	movq	8(%r14), %rdi
	vaddpd	-1536(%rax,%rsi), %zmm0, %zmm0
	shlq	$8, %rdi
	addq	%rcx, %rdi
	vmovupd	%zmm0, (%rsi,%rdi)
	vmovupd	-512(%rax,%rsi), %zmm0
	vmovupd	%zmm0, (%rax,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rdx
	jne	.LBB7_7
.LBB7_8:
	leaq	8192(%rbx), %rbp
	leaq	3(%r13), %rax
	movl	$256, %ecx
	.p2align	4
.LBB7_9:
	vmovupd	(%rbx,%rcx), %zmm0
	movq	8(%r14), %rdx
	decq	%rax
	vaddpd	6656(%rbx,%rcx), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, (%rcx,%rdx)
	vmovupd	7680(%rbx,%rcx), %zmm0
	vmovupd	%zmm0, 8192(%rbx,%rcx)
	addq	$64, %rcx
	cmpq	$3, %rax
	ja	.LBB7_9
	leaq	8(%rsp), %rdi
	movq	%r14, %rcx
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r9, %r14
	vzeroupper
	callq	*%r9
	cmpq	$64, 40(%rsp)
	movl	%eax, 20(%rsp)
	jae	.LBB7_12
	movq	192(%rsp), %rcx
	movq	304(%rsp), %r8
	xorl	%edx, %edx
	movq	%r14, %r9
	jmp	.LBB7_19
.LBB7_12:
	movq	304(%rsp), %r8
	leaq	-8(%r13), %rax
	movq	%r14, %r9
	movq	%rax, %rdi
	shrq	$3, %rdi
	je	.LBB7_13
	movq	192(%rsp), %rcx
	incq	%rdi
	xorl	%edx, %edx
	andq	$-2, %rdi
	negq	%rdi
	.p2align	4
.LBB7_15:
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7680(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	64(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7744(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	128(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7808(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	192(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7872(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	256(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7936(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	320(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	384(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	448(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8128(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	512(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	576(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	640(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	704(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8384(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	768(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8448(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	832(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8512(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	896(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8576(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	addq	$2, %rdi
	vmovupd	960(%rsi,%rdx,8), %zmm0
	vmovupd	%zmm0, 8640(%rbx,%rdx,8)
	leaq	128(%rdx), %rdx
	jne	.LBB7_15
	testb	$8, %al
	je	.LBB7_17
	testq	%r12, %r12
	jne	.LBB7_19
	jmp	.LBB7_21
.LBB7_13:
	movq	192(%rsp), %rcx
	xorl	%edx, %edx
.LBB7_17:
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7680(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	64(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7744(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	128(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7808(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	192(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7872(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	256(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7936(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	320(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	384(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovupd	448(%rax,%rdx,8), %zmm0
	vmovupd	%zmm0, 8128(%rbx,%rdx,8)
	addq	$64, %rdx
	testq	%r12, %r12
	je	.LBB7_21
.LBB7_19:
	leaq	7680(%rbx,%rdx,8), %rax
	leaq	(%r15,%rdx,8), %rdi
	shll	$6, %r12d
	xorl	%edx, %edx
	.p2align	4
.LBB7_20:
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%rdi, %rsi
	vmovupd	(%rdx,%rsi), %zmm0
	vmovupd	%zmm0, (%rax,%rdx)
	addq	$64, %rdx
	cmpq	%rdx, %r12
	jne	.LBB7_20
.LBB7_21:
	leaq	3(%r13), %r14
	leaq	8448(%rbx), %r12
	addq	$4, %r13
	xorl	%eax, %eax
	.p2align	4
.LBB7_22:
	movq	16(%rcx), %rdx
	decq	%r13
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	256(%rax,%rdx), %zmm0
	vmovupd	%zmm0, 7936(%rbx,%rax)
	addq	$64, %rax
	cmpq	$4, %r13
	ja	.LBB7_22
	xorl	%eax, %eax
	movq	%r14, %rsi
	.p2align	4
.LBB7_24:
	vmovupd	(%rbx,%rax), %zmm0
	movq	8(%rcx), %rdx
	decq	%rsi
	vsubpd	6656(%rbx,%rax), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, (%rax,%rdx)
	addq	$64, %rax
	cmpq	$3, %rsi
	ja	.LBB7_24
	movl	$256, %eax
	movq	%r14, %rsi
	.p2align	4
.LBB7_26:
	vmovupd	(%rbx,%rax), %zmm0
	movq	8(%rcx), %rdx
	decq	%rsi
	vsubpd	6656(%rbx,%rax), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, (%rax,%rdx)
	addq	$64, %rax
	cmpq	$3, %rsi
	ja	.LBB7_26
	leaq	32(%rsp), %rdi
	leaq	24(%rsp), %rsi
	movq	%r15, %rdx
	vzeroupper
	callq	*%r9
	movabsq	$.LCPI7_0, %rcx
	movq	192(%rsp), %rdi
	movq	%r15, %rdx
	vbroadcastsd	(%rcx), %zmm0
	movabsq	$.LCPI7_1, %rcx
	vbroadcastsd	(%rcx), %zmm1
	movq	%r14, %rcx
	.p2align	4
.LBB7_28:
	movq	16(%rdi), %rsi
	vmovupd	-512(%rbp), %zmm2
	decq	%rcx
	shlq	$8, %rsi
	vaddpd	(%rdx,%rsi), %zmm2, %zmm2
	addq	$64, %rdx
	vmulpd	%zmm0, %zmm2, %zmm2
	vsubpd	(%rbp), %zmm2, %zmm2
	vandpd	%zmm1, %zmm2, %zmm2
	vmovupd	%zmm2, -1024(%rbp)
	addq	$64, %rbp
	cmpq	$3, %rcx
	ja	.LBB7_28
	movq	48(%rsp), %rbx
	addq	$256, %r15
	.p2align	4
.LBB7_30:
	movq	16(%rdi), %rcx
	vmovupd	-512(%r12), %zmm2
	decq	%r14
	shlq	$8, %rcx
	vaddpd	(%r15,%rcx), %zmm2, %zmm2
	addq	$64, %r15
	vmulpd	%zmm0, %zmm2, %zmm2
	vsubpd	(%r12), %zmm2, %zmm2
	vandpd	%zmm1, %zmm2, %zmm2
	vmovupd	%zmm2, -1024(%r12)
	addq	$64, %r12
	cmpq	$3, %r14
	ja	.LBB7_30
	movl	20(%rsp), %ebp
.LBB7_33:
	orl	%eax, %ebp
	movslq	%ebp, %rax
	movq	%rax, (%rbx)
	xorl	%eax, %eax
	addq	$56, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.Lfunc_end7:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v27B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_2924Literal_5bint_5d_2828_29x, .Lfunc_end7-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v27B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_2924Literal_5bint_5d_2828_29x
	.cfi_endproc

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI8_0:
	.quad	0x3f62d77318fc5048
.LCPI8_1:
	.quad	0x3fe0000000000000
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6wantedB3v46B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6wantedB3v46B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6wantedB3v46B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx:
	pushq	%r15
	pushq	%r14
	pushq	%rbx
	movq	88(%rsp), %rax
	leaq	7(%rax), %r8
	movq	%r8, %rcx
	shrq	$3, %rcx
	testq	%rax, %rax
	setle	%al
	testq	%rcx, %rcx
	sete	%dl
	orb	%al, %dl
	jne	.LBB8_25
	movq	80(%rsp), %rdx
	movq	32(%rsp), %rax
	vcvtsi2sd	%rdx, %xmm15, %xmm1
	vbroadcastsd	%xmm1, %zmm1
	cmpq	$1, %rdx
	jle	.LBB8_2
	movabsq	$.LCPI8_0, %r10
	movabsq	$.LCPI8_1, %r9
	cmpq	$1, %rcx
	jne	.LBB8_8
	xorl	%esi, %esi
	jmp	.LBB8_15
.LBB8_2:
	movl	%ecx, %edx
	andl	$7, %edx
	cmpq	$64, %r8
	jae	.LBB8_4
	xorl	%r8d, %r8d
	jmp	.LBB8_23
.LBB8_8:
	vbroadcastsd	(%r10), %zmm2
	vbroadcastsd	(%r9), %zmm4
	vmovsd	(%r9), %xmm5
	andq	$-2, %rcx
	xorl	%esi, %esi
	vxorpd	%xmm3, %xmm3, %xmm3
	xorl	%r11d, %r11d
	.p2align	4
.LBB8_9:
	vmovupd	13568(%rax,%rsi,8), %zmm7
	vmulpd	6656(%rax,%rsi,8), %zmm2, %zmm10
	vmulpd	6912(%rax,%rsi,8), %zmm2, %zmm11
	vminpd	13312(%rax,%rsi,8), %zmm1, %zmm6
	vmovupd	7168(%rax,%rsi,8), %zmm8
	vmovupd	7424(%rax,%rsi,8), %zmm9
	movq	%rdx, %r14
	movq	%rdx, %rbx
	vcmpltpd	%zmm3, %zmm7, %k0
	.p2align	4
.LBB8_10:
	vcvtsi2sd	%r14, %xmm15, %xmm12
	shrq	%rbx
	vmulsd	%xmm0, %xmm12, %xmm13
	vbroadcastsd	%xmm13, %zmm13
	vmulpd	%zmm13, %zmm8, %zmm14
	vmulpd	%zmm13, %zmm9, %zmm13
	vcmpltpd	%zmm13, %zmm11, %k2
	vcmpltpd	%zmm14, %zmm10, %k1
	vbroadcastsd	%xmm12, %zmm13
	vmulsd	%xmm5, %xmm12, %xmm12
	korb	%k2, %k1, %k1
	vcmpeqpd	%zmm13, %zmm6, %k2
	korb	%k0, %k1, %k1
	vcmpgtpd	%zmm4, %zmm7, %k2 {%k2}
	kandb	%k1, %k2, %k1
	vbroadcastsd	%xmm12, %zmm6 {%k1}
	cmpq	$3, %r14
	movq	%rbx, %r14
	ja	.LBB8_10
	vmovupd	%zmm6, 13056(%rax,%rsi,8)
	movq	%rsi, %rbx
	orq	$8, %rbx
	movq	%rdx, %r15
	movq	%rdx, %r14
	vmovupd	13632(%rax,%rsi,8), %zmm7
	vmulpd	6720(%rax,%rsi,8), %zmm2, %zmm10
	vmulpd	6976(%rax,%rsi,8), %zmm2, %zmm11
	vminpd	13376(%rax,%rsi,8), %zmm1, %zmm6
	vmovupd	7232(%rax,%rsi,8), %zmm8
	vmovupd	7488(%rax,%rsi,8), %zmm9
	vcmpltpd	%zmm3, %zmm7, %k0
	.p2align	4
.LBB8_12:
	vcvtsi2sd	%r15, %xmm15, %xmm12
	shrq	%r14
	vmulsd	%xmm0, %xmm12, %xmm13
	vbroadcastsd	%xmm13, %zmm13
	vmulpd	%zmm13, %zmm8, %zmm14
	vmulpd	%zmm13, %zmm9, %zmm13
	vcmpltpd	%zmm13, %zmm11, %k2
	vcmpltpd	%zmm14, %zmm10, %k1
	vbroadcastsd	%xmm12, %zmm13
	vmulsd	%xmm5, %xmm12, %xmm12
	korb	%k2, %k1, %k1
	vcmpeqpd	%zmm13, %zmm6, %k2
	korb	%k0, %k1, %k1
	vcmpgtpd	%zmm4, %zmm7, %k2 {%k2}
	kandb	%k1, %k2, %k1
	vbroadcastsd	%xmm12, %zmm6 {%k1}
	cmpq	$3, %r15
	movq	%r14, %r15
	ja	.LBB8_12
	addq	$16, %rsi
	addq	$2, %r11
	vmovupd	%zmm6, 13056(%rax,%rbx,8)
	cmpq	%rcx, %r11
	jne	.LBB8_9
	testb	$8, %r8b
	je	.LBB8_25
.LBB8_15:
	vmovupd	13568(%rax,%rsi,8), %zmm2
	vbroadcastsd	(%r10), %zmm6
	vxorpd	%xmm7, %xmm7, %xmm7
	vminpd	13312(%rax,%rsi,8), %zmm1, %zmm1
	vmovupd	7168(%rax,%rsi,8), %zmm3
	vmovupd	7424(%rax,%rsi,8), %zmm4
	vmovsd	(%r9), %xmm8
	movq	%rdx, %rcx
	vmulpd	6656(%rax,%rsi,8), %zmm6, %zmm5
	vmulpd	6912(%rax,%rsi,8), %zmm6, %zmm6
	vcmpltpd	%zmm7, %zmm2, %k0
	vbroadcastsd	(%r9), %zmm7
	.p2align	4
.LBB8_16:
	vcvtsi2sd	%rdx, %xmm15, %xmm9
	shrq	%rcx
	vmulsd	%xmm0, %xmm9, %xmm10
	vbroadcastsd	%xmm10, %zmm10
	vmulpd	%zmm10, %zmm3, %zmm11
	vmulpd	%zmm10, %zmm4, %zmm10
	vcmpltpd	%zmm10, %zmm6, %k2
	vcmpltpd	%zmm11, %zmm5, %k1
	vbroadcastsd	%xmm9, %zmm10
	vmulsd	%xmm8, %xmm9, %xmm9
	korb	%k2, %k1, %k1
	vcmpeqpd	%zmm10, %zmm1, %k2
	korb	%k0, %k1, %k1
	vcmpgtpd	%zmm7, %zmm2, %k2 {%k2}
	kandb	%k1, %k2, %k1
	vbroadcastsd	%xmm9, %zmm1 {%k1}
	cmpq	$3, %rdx
	movq	%rcx, %rdx
	ja	.LBB8_16
	vmovupd	%zmm1, 13056(%rax,%rsi,8)
	jmp	.LBB8_25
.LBB8_4:
	addq	$-8, %rcx
	movq	%rcx, %rsi
	shrq	$3, %rsi
	je	.LBB8_5
	incq	%rsi
	xorl	%r8d, %r8d
	andq	$-2, %rsi
	.p2align	4
.LBB8_19:
	vminpd	13312(%rax,%r8,8), %zmm1, %zmm0
	addq	$-2, %rsi
	vmovupd	%zmm0, 13056(%rax,%r8,8)
	vminpd	13376(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13120(%rax,%r8,8)
	vminpd	13440(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13184(%rax,%r8,8)
	vminpd	13504(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13248(%rax,%r8,8)
	vminpd	13568(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13312(%rax,%r8,8)
	vminpd	13632(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13376(%rax,%r8,8)
	vminpd	13696(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13440(%rax,%r8,8)
	vminpd	13760(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13504(%rax,%r8,8)
	vminpd	13824(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13568(%rax,%r8,8)
	vminpd	13888(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13632(%rax,%r8,8)
	vminpd	13952(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13696(%rax,%r8,8)
	vminpd	14016(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13760(%rax,%r8,8)
	vminpd	14080(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13824(%rax,%r8,8)
	vminpd	14144(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13888(%rax,%r8,8)
	vminpd	14208(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13952(%rax,%r8,8)
	vminpd	14272(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 14016(%rax,%r8,8)
	leaq	128(%r8), %r8
	jne	.LBB8_19
	testb	$8, %cl
	je	.LBB8_21
	jmp	.LBB8_22
.LBB8_5:
	xorl	%r8d, %r8d
.LBB8_21:
	vminpd	13312(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13056(%rax,%r8,8)
	vminpd	13376(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13120(%rax,%r8,8)
	vminpd	13440(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13184(%rax,%r8,8)
	vminpd	13504(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13248(%rax,%r8,8)
	vminpd	13568(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13312(%rax,%r8,8)
	vminpd	13632(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13376(%rax,%r8,8)
	vminpd	13696(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13440(%rax,%r8,8)
	vminpd	13760(%rax,%r8,8), %zmm1, %zmm0
	vmovupd	%zmm0, 13504(%rax,%r8,8)
	addq	$64, %r8
.LBB8_22:
	testq	%rdx, %rdx
	je	.LBB8_25
.LBB8_23:
	leaq	13312(%rax,%r8,8), %rax
	shll	$6, %edx
	xorl	%ecx, %ecx
	.p2align	4
.LBB8_24:
	vminpd	(%rax,%rcx), %zmm1, %zmm0
	vmovupd	%zmm0, -256(%rax,%rcx)
	addq	$64, %rcx
	cmpq	%rcx, %rdx
	jne	.LBB8_24
.LBB8_25:
	movq	$0, (%rdi)
	xorl	%eax, %eax
	popq	%rbx
	popq	%r14
	popq	%r15
	vzeroupper
	retq
.Lfunc_end8:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6wantedB3v46B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx, .Lfunc_end8-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6wantedB3v46B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI9_0:
	.quad	0x3fe0000000000000
.LCPI9_1:
	.quad	0x3f62d77318fc5048
.LCPI9_2:
	.quad	0x7fffffffffffffff
.LCPI9_3:
	.quad	0x4008000000000000
.LCPI9_4:
	.quad	0x3fb999999999999a
.LCPI9_5:
	.quad	0x3ff0000000000000
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9attemptedB3v48B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxddx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9attemptedB3v48B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxddx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9attemptedB3v48B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxddx:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$296, %rsp
	.cfi_def_cfa_offset 352
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	%rcx, %r13
	movq	760(%rsp), %rcx
	movq	432(%rsp), %rbp
	movq	416(%rsp), %r12
	movq	%r9, %r11
	movq	352(%rsp), %r9
	movq	%r8, %r15
	movq	%rdx, 56(%rsp)
	movq	%rsi, %r14
	movq	%rdi, 152(%rsp)
	movq	$0, 280(%rsp)
	movl	$0, 44(%rsp)
	movq	$0, 272(%rsp)
	movl	$0, 40(%rsp)
	movq	$0, 264(%rsp)
	movq	$0, 168(%rsp)
	movq	$0, 256(%rsp)
	movl	$0, 36(%rsp)
	movq	$0, 248(%rsp)
	movq	$0, 96(%rsp)
	movq	$0, 240(%rsp)
	movq	$0, 232(%rsp)
	movq	$0, 224(%rsp)
	movq	$0, 216(%rsp)
	movq	$0, 208(%rsp)
	movq	$0, 88(%rsp)
	movq	$0, 200(%rsp)
	vmovsd	%xmm1, 160(%rsp)
	movq	$0, 288(%rsp)
	vcvtsi2sd	%rcx, %xmm15, %xmm2
	movl	%ecx, %r10d
	andl	$1, %r10d
	addq	744(%rsp), %r10
	movq	%rcx, %rax
	sarq	%rax
	leaq	(%rax,%rax,2), %rax
	vmulsd	%xmm2, %xmm0, %xmm0
	vmovapd	%xmm2, 128(%rsp)
	addq	%rax, %r10
	movabsq	$.LCPI9_0, %rax
	vmovapd	%xmm0, 176(%rsp)
	vmulsd	(%rax), %xmm0, %xmm0
	vmovsd	%xmm0, 16(%rsp)
	vaddsd	%xmm0, %xmm1, %xmm0
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx, %rax
	movq	%r8, %rcx
	movq	%r11, %rbx
	leaq	296(%rsp), %rdi
	leaq	288(%rsp), %rsi
	movq	%r13, %rdx
	movq	%r11, %r8
	vmovsd	%xmm0, 88(%rsp)
	pushq	776(%rsp)
	.cfi_adjust_cfa_offset 8
	movq	%r10, 208(%rsp)
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	callq	*%rax
	addq	$336, %rsp
	.cfi_adjust_cfa_offset -336
	cmpl	$-2, %eax
	je	.LBB9_2
	testl	%eax, %eax
	jne	.LBB9_44
.LBB9_2:
	vmovsd	16(%rsp), %xmm0
	movq	%r14, 24(%rsp)
	movq	%r12, %r11
	movq	56(%rsp), %r12
	movq	488(%rsp), %r14
	movq	768(%rsp), %r10
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v32B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29d24Literal_5bint_5d_2822_2924Literal_5bint_5d_2816_29x, %rax
	movl	$0, 44(%rsp)
	leaq	44(%rsp), %rdi
	leaq	272(%rsp), %rsi
	movq	%r13, %rcx
	movq	%r15, %r8
	movq	%rbx, %r9
	movq	%r12, %rdx
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	$16
	.cfi_adjust_cfa_offset 8
	pushq	$22
	.cfi_adjust_cfa_offset 8
	pushq	$14
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	%r11
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	callq	*%rax
	addq	$208, %rsp
	.cfi_adjust_cfa_offset -208
	testl	%eax, %eax
	jne	.LBB9_45
	vmovsd	16(%rsp), %xmm0
	movslq	44(%rsp), %rax
	movl	$0, 40(%rsp)
	leaq	40(%rsp), %rdi
	leaq	264(%rsp), %rsi
	movq	%r12, %rdx
	movq	%r13, %rcx
	movq	%r15, %r8
	movq	%rbx, %r9
	movq	%rax, 8(%rsp)
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v34B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2818_29x, %rax
	pushq	768(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	$18
	.cfi_adjust_cfa_offset 8
	pushq	$24
	.cfi_adjust_cfa_offset 8
	pushq	$16
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r10
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %rbp
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	movq	552(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	callq	*%rax
	addq	$208, %rsp
	.cfi_adjust_cfa_offset -208
	movq	424(%rsp), %r11
	movq	440(%rsp), %rcx
	movq	448(%rsp), %rdx
	testl	%eax, %eax
	jne	.LBB9_45
	vmovsd	160(%rsp), %xmm0
	movq	760(%rsp), %rax
	movq	744(%rsp), %rsi
	movq	%rbp, %r10
	movq	%rcx, %rbp
	movslq	40(%rsp), %rcx
	movq	%rbx, %r8
	movq	%r11, %rbx
	movq	%rdx, %r11
	movq	$0, 168(%rsp)
	vaddsd	176(%rsp), %xmm0, %xmm0
	leaq	(%rax,%rax,2), %rax
	movq	%rcx, 72(%rsp)
	leaq	-1(%rsi,%rax), %rax
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	movq	360(%rsp), %r9
	leaq	176(%rsp), %rdi
	leaq	264(%rsp), %rsi
	movq	%r13, 72(%rsp)
	movq	%r13, %rdx
	movq	%r15, 56(%rsp)
	movq	%r15, %rcx
	movq	%r8, 24(%rsp)
	pushq	776(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r11
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	movq	688(%rsp), %rbp
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	movq	688(%rsp), %r13
	pushq	%r13
	.cfi_adjust_cfa_offset 8
	movq	688(%rsp), %r15
	pushq	%r15
	.cfi_adjust_cfa_offset 8
	movq	688(%rsp), %r12
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	movq	688(%rsp), %rbx
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx, %rax
	callq	*%rax
	addq	$336, %rsp
	.cfi_adjust_cfa_offset -336
	movq	352(%rsp), %r10
	cmpl	$-2, %eax
	je	.LBB9_6
	testl	%eax, %eax
	jne	.LBB9_45
.LBB9_6:
	vmovapd	176(%rsp), %xmm0
	movq	56(%rsp), %rdx
	movq	64(%rsp), %rcx
	movq	48(%rsp), %r8
	movq	16(%rsp), %r9
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v36B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2820_29x, %rax
	movl	$0, 36(%rsp)
	leaq	36(%rsp), %rdi
	leaq	248(%rsp), %rsi
	pushq	768(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	$20
	.cfi_adjust_cfa_offset 8
	pushq	$24
	.cfi_adjust_cfa_offset 8
	pushq	$18
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r13
	.cfi_adjust_cfa_offset 8
	pushq	%r15
	.cfi_adjust_cfa_offset 8
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	callq	*%rax
	addq	$208, %rsp
	.cfi_adjust_cfa_offset -208
	testl	%eax, %eax
	jne	.LBB9_45
	movq	72(%rsp), %rcx
	movslq	36(%rsp), %rax
	orq	8(%rsp), %rcx
	orq	%rcx, %rax
	cmpq	$2, 760(%rsp)
	movq	%rax, 8(%rsp)
	jge	.LBB9_47
	vmovsd	80(%rsp), %xmm0
	movq	16(%rsp), %r8
	movq	48(%rsp), %rcx
	movq	64(%rsp), %r13
	movq	392(%rsp), %rax
	movq	400(%rsp), %r10
	movq	416(%rsp), %r11
	movq	424(%rsp), %r15
	movq	440(%rsp), %r12
.LBB9_36:
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	movq	360(%rsp), %r9
	leaq	224(%rsp), %rdi
	leaq	216(%rsp), %rsi
	movq	%r13, %rdx
	pushq	776(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	208(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r12
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	%r15
	.cfi_adjust_cfa_offset 8
	pushq	%r11
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r10
	.cfi_adjust_cfa_offset 8
	pushq	%rax
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx, %rax
	vzeroupper
	callq	*%rax
	addq	$336, %rsp
	.cfi_adjust_cfa_offset -336
	cmpl	$-2, %eax
	je	.LBB9_38
	testl	%eax, %eax
	jne	.LBB9_45
.LBB9_38:
	movq	768(%rsp), %rax
	leaq	7(%rax), %rcx
	movq	%rcx, %r15
	shrq	$3, %r15
	testq	%rax, %rax
	setle	%al
	testq	%r15, %r15
	sete	%r12b
	orb	%al, %r12b
	jne	.LBB9_102
	movl	%r15d, %eax
	andl	$7, %eax
	cmpq	$64, %rcx
	jae	.LBB9_91
	xorl	%esi, %esi
	jmp	.LBB9_98
.LBB9_47:
	movq	768(%rsp), %rax
	movq	48(%rsp), %r8
	movq	400(%rsp), %r11
	movq	408(%rsp), %r13
	leaq	7(%rax), %rdx
	movq	%rdx, %r12
	shrq	$3, %r12
	testq	%rax, %rax
	movq	%rdx, 72(%rsp)
	setle	%al
	testq	%r12, %r12
	sete	%cl
	orb	%al, %cl
	movq	64(%rsp), %rcx
	jne	.LBB9_16
	movl	%r12d, %eax
	andl	$7, %eax
	cmpq	$64, %rdx
	jae	.LBB9_50
	xorl	%r10d, %r10d
	jmp	.LBB9_14
.LBB9_91:
	leaq	-8(%r15), %rcx
	movq	%rcx, %rdx
	shrq	$3, %rdx
	je	.LBB9_92
	incq	%rdx
	xorl	%esi, %esi
	andq	$-2, %rdx
	negq	%rdx
	.p2align	4
.LBB9_94:
	vmovups	5632(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, (%rdi,%rsi,8)
	vmovups	5696(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 64(%rdi,%rsi,8)
	vmovups	5760(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 128(%rdi,%rsi,8)
	vmovups	5824(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 192(%rdi,%rsi,8)
	vmovups	5888(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 256(%rdi,%rsi,8)
	vmovups	5952(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 320(%rdi,%rsi,8)
	vmovups	6016(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 384(%rdi,%rsi,8)
	vmovups	6080(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 448(%rdi,%rsi,8)
	vmovups	6144(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 512(%rdi,%rsi,8)
	vmovups	6208(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 576(%rdi,%rsi,8)
	vmovups	6272(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 640(%rdi,%rsi,8)
	vmovups	6336(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 704(%rdi,%rsi,8)
	vmovups	6400(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 768(%rdi,%rsi,8)
	vmovups	6464(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 832(%rdi,%rsi,8)
	vmovups	6528(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	%zmm0, 896(%rdi,%rsi,8)
	vmovupd	6592(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	addq	$2, %rdx
	vmovupd	%zmm0, 960(%rdi,%rsi,8)
	leaq	128(%rsi), %rsi
	jne	.LBB9_94
	testb	$8, %cl
	je	.LBB9_96
	jmp	.LBB9_97
.LBB9_50:
	leaq	-8(%r12), %rdx
	movq	%rdx, %rsi
	shrq	$3, %rsi
	je	.LBB9_51
	decq	%rsi
	shrq	%rsi
	je	.LBB9_53
	incq	%rsi
	leaq	9920(%r14), %rdi
	xorl	%r10d, %r10d
	movq	%rsi, %r9
	andq	$-2, %r9
	negq	%r9
	.p2align	4
.LBB9_55:
	vmovups	-4800(%rdi,%r10,8), %zmm0
	vmovups	-4736(%rdi,%r10,8), %zmm1
	vmovups	-4672(%rdi,%r10,8), %zmm2
	vmovups	-4608(%rdi,%r10,8), %zmm3
	vmovups	%zmm0, -2240(%rdi,%r10,8)
	vmovups	-4544(%rdi,%r10,8), %zmm0
	vmovups	%zmm1, -2176(%rdi,%r10,8)
	vmovups	-4480(%rdi,%r10,8), %zmm1
	vmovups	%zmm2, -2112(%rdi,%r10,8)
	vmovups	-4416(%rdi,%r10,8), %zmm2
	vmovups	%zmm3, -2048(%rdi,%r10,8)
	vmovups	-4352(%rdi,%r10,8), %zmm3
	vmovups	%zmm0, -1984(%rdi,%r10,8)
	vmovups	-4288(%rdi,%r10,8), %zmm0
	vmovups	%zmm1, -1920(%rdi,%r10,8)
	vmovups	-4224(%rdi,%r10,8), %zmm1
	vmovups	%zmm2, -1856(%rdi,%r10,8)
	vmovups	-4160(%rdi,%r10,8), %zmm2
	vmovups	%zmm3, -1792(%rdi,%r10,8)
	vmovups	%zmm0, -1728(%rdi,%r10,8)
	vmovups	%zmm1, -1664(%rdi,%r10,8)
	vmovups	%zmm2, -1600(%rdi,%r10,8)
	vmovups	-4096(%rdi,%r10,8), %zmm0
	vmovups	-4032(%rdi,%r10,8), %zmm1
	vmovups	-3968(%rdi,%r10,8), %zmm2
	vmovups	-3904(%rdi,%r10,8), %zmm3
	vmovups	%zmm0, -1536(%rdi,%r10,8)
	vmovups	-3840(%rdi,%r10,8), %zmm0
	vmovups	%zmm1, -1472(%rdi,%r10,8)
	vmovups	-3776(%rdi,%r10,8), %zmm1
	vmovups	%zmm1, -1216(%rdi,%r10,8)
	vmovups	%zmm2, -1408(%rdi,%r10,8)
	vmovups	-3712(%rdi,%r10,8), %zmm1
	vmovups	%zmm1, -1152(%rdi,%r10,8)
	vmovups	%zmm3, -1344(%rdi,%r10,8)
	vmovups	-3648(%rdi,%r10,8), %zmm1
	vmovups	%zmm1, -1088(%rdi,%r10,8)
	vmovups	%zmm0, -1280(%rdi,%r10,8)
	vmovups	-3584(%rdi,%r10,8), %zmm0
	vmovups	-3520(%rdi,%r10,8), %zmm1
	vmovups	-3456(%rdi,%r10,8), %zmm2
	vmovups	-3392(%rdi,%r10,8), %zmm3
	vmovups	%zmm0, -1024(%rdi,%r10,8)
	vmovups	-3328(%rdi,%r10,8), %zmm0
	vmovups	%zmm1, -960(%rdi,%r10,8)
	vmovups	-3264(%rdi,%r10,8), %zmm1
	vmovups	%zmm2, -896(%rdi,%r10,8)
	vmovups	-3200(%rdi,%r10,8), %zmm2
	vmovups	%zmm3, -832(%rdi,%r10,8)
	vmovups	-3136(%rdi,%r10,8), %zmm3
	vmovups	%zmm0, -768(%rdi,%r10,8)
	vmovups	-3072(%rdi,%r10,8), %zmm0
	vmovups	%zmm1, -704(%rdi,%r10,8)
	vmovups	-3008(%rdi,%r10,8), %zmm1
	vmovups	%zmm2, -640(%rdi,%r10,8)
	vmovupd	-2944(%rdi,%r10,8), %zmm2
	vmovups	%zmm3, -576(%rdi,%r10,8)
	vmovupd	-2880(%rdi,%r10,8), %zmm3
	vmovups	%zmm0, -512(%rdi,%r10,8)
	vmovups	-2816(%rdi,%r10,8), %zmm0
	vmovups	%zmm1, -448(%rdi,%r10,8)
	vmovups	-2752(%rdi,%r10,8), %zmm1
	vmovups	%zmm1, -192(%rdi,%r10,8)
	vmovupd	%zmm2, -384(%rdi,%r10,8)
	vmovups	-2688(%rdi,%r10,8), %zmm1
	vmovups	%zmm1, -128(%rdi,%r10,8)
	vmovupd	%zmm3, -320(%rdi,%r10,8)
	vmovupd	-2624(%rdi,%r10,8), %zmm1
	vmovupd	%zmm1, -64(%rdi,%r10,8)
	vmovups	%zmm0, -256(%rdi,%r10,8)
	vmovupd	-2560(%rdi,%r10,8), %zmm0
	vmovupd	%zmm0, (%rdi,%r10,8)
	addq	$256, %r10
	addq	$2, %r9
	jne	.LBB9_55
	testb	$1, %sil
	jne	.LBB9_10
	testb	$8, %dl
	je	.LBB9_12
.LBB9_13:
	testq	%rax, %rax
	jne	.LBB9_14
	jmp	.LBB9_16
.LBB9_92:
	xorl	%esi, %esi
.LBB9_96:
	vmovups	5632(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	%zmm0, (%rcx,%rsi,8)
	vmovups	5696(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	%zmm0, 64(%rcx,%rsi,8)
	vmovups	5760(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	%zmm0, 128(%rcx,%rsi,8)
	vmovups	5824(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	%zmm0, 192(%rcx,%rsi,8)
	vmovups	5888(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	%zmm0, 256(%rcx,%rsi,8)
	vmovups	5952(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	%zmm0, 320(%rcx,%rsi,8)
	vmovups	6016(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	%zmm0, 384(%rcx,%rsi,8)
	vmovupd	6080(%r14,%rsi,8), %zmm0
	movq	8(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovupd	%zmm0, 448(%rcx,%rsi,8)
	addq	$64, %rsi
.LBB9_97:
	testq	%rax, %rax
	je	.LBB9_100
.LBB9_98:
	leaq	(%rbx,%rsi,8), %rcx
	leaq	5632(%r14,%rsi,8), %rdx
	shll	$6, %eax
	xorl	%esi, %esi
	.p2align	4
.LBB9_99:
	vmovupd	(%rdx,%rsi), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rcx, %rdi
	vmovupd	%zmm0, (%rsi,%rdi)
	addq	$64, %rsi
	cmpq	%rsi, %rax
	jne	.LBB9_99
.LBB9_100:
	leaq	5888(%r14), %rax
	leaq	256(%rbx), %rcx
	leaq	4(%r15), %rdx
	.p2align	4
.LBB9_101:
	vmovupd	(%rax), %zmm0
	movq	8(%rbp), %rsi
	addq	$64, %rax
	decq	%rdx
	shlq	$8, %rsi
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rcx
	cmpq	$4, %rdx
	ja	.LBB9_101
.LBB9_102:
	movq	$0, 88(%rsp)
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	movq	64(%rsp), %rdx
	movq	56(%rsp), %r8
	movq	24(%rsp), %r9
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6probedB3v42B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEx, %rax
	leaq	96(%rsp), %rdi
	leaq	208(%rsp), %rsi
	movq	%r13, %rcx
	pushq	776(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	pushq	536(%rsp)
	.cfi_adjust_cfa_offset 8
	vzeroupper
	callq	*%rax
	addq	$192, %rsp
	.cfi_adjust_cfa_offset -192
	testl	%eax, %eax
	jne	.LBB9_45
	cmpq	$2, 760(%rsp)
	movq	8(%rsp), %rcx
	setl	%al
	orq	88(%rsp), %rcx
	orb	%r12b, %al
	jne	.LBB9_43
	vmovapd	176(%rsp), %xmm2
	movabsq	$.LCPI9_4, %rdx
	movabsq	$.LCPI9_3, %rax
	movabsq	$.LCPI9_1, %rsi
	addq	$4, %r15
	vxorpd	%xmm4, %xmm4, %xmm4
	vbroadcastsd	(%rdx), %zmm5
	movabsq	$.LCPI9_0, %rdx
	vbroadcastsd	(%rax), %zmm1
	vbroadcastsd	(%rsi), %zmm3
	movabsq	$.LCPI9_2, %rsi
	movabsq	$.LCPI9_5, %rax
	vbroadcastsd	(%rdx), %zmm7
	vbroadcastsd	(%rsi), %zmm6
	vbroadcastsd	%xmm2, %zmm0
	vmulsd	%xmm2, %xmm2, %xmm2
	vbroadcastsd	%xmm2, %zmm2
	.p2align	4
.LBB9_42:
	vmovupd	5632(%r14), %zmm12
	vmovupd	(%r14), %zmm9
	vmovupd	256(%r14), %zmm10
	vmovupd	9216(%r14), %zmm8
	vmovupd	5888(%r14), %zmm13
	decq	%r15
	vaddpd	6144(%r14), %zmm9, %zmm11
	vaddpd	6400(%r14), %zmm10, %zmm10
	vaddpd	%zmm12, %zmm12, %zmm12
	vsubpd	%zmm12, %zmm11, %zmm11
	vmulpd	1536(%r14), %zmm11, %zmm12
	vmulpd	2048(%r14), %zmm11, %zmm11
	vsubpd	%zmm12, %zmm8, %zmm8
	vaddpd	%zmm13, %zmm13, %zmm12
	vandpd	2560(%r14), %zmm6, %zmm13
	vsubpd	%zmm12, %zmm10, %zmm10
	vmulpd	1792(%r14), %zmm10, %zmm12
	vmulpd	2304(%r14), %zmm10, %zmm10
	vmulpd	%zmm13, %zmm2, %zmm13
	vcmplepd	%zmm5, %zmm13, %k1
	vsubpd	%zmm12, %zmm8, %zmm8
	vandpd	8704(%r14), %zmm6, %zmm12
	vandpd	%zmm6, %zmm8, %zmm8
	vaddpd	7168(%r14), %zmm8, %zmm8
	vmulpd	%zmm1, %zmm12, %zmm12
	vaddpd	%zmm8, %zmm12, %zmm8
	vaddpd	9728(%r14), %zmm8, %zmm8
	vmulpd	6656(%r14), %zmm3, %zmm12
	vmulpd	%zmm8, %zmm0, %zmm8
	vcmplepd	%zmm12, %zmm8, %k1 {%k1}
	vmovupd	9472(%r14), %zmm8
	vcmpordpd	%zmm4, %zmm9, %k0 {%k1}
	vandpd	8960(%r14), %zmm6, %zmm9
	vsubpd	%zmm11, %zmm8, %zmm8
	vmulpd	%zmm1, %zmm9, %zmm9
	vsubpd	%zmm10, %zmm8, %zmm8
	vandpd	%zmm6, %zmm8, %zmm8
	vaddpd	7424(%r14), %zmm8, %zmm8
	vaddpd	%zmm8, %zmm9, %zmm8
	vaddpd	9984(%r14), %zmm8, %zmm8
	vmulpd	6912(%r14), %zmm3, %zmm9
	vmulpd	%zmm8, %zmm0, %zmm8
	vcmplepd	%zmm9, %zmm8, %k1
	vandpd	3328(%r14), %zmm6, %zmm9
	vmulpd	%zmm9, %zmm2, %zmm8
	vcmplepd	%zmm5, %zmm8, %k1 {%k1}
	kandb	%k1, %k0, %k0
	vcmpgtpd	13568(%r14), %zmm7, %k1
	korb	%k0, %k1, %k1
	vbroadcastsd	(%rax), %zmm8 {%k1} {z}
	vmovupd	%zmm8, 13824(%r14)
	addq	$64, %r14
	cmpq	$4, %r15
	ja	.LBB9_42
.LBB9_43:
	movq	152(%rsp), %rax
	movq	%rcx, (%rax)
	xorl	%eax, %eax
	jmp	.LBB9_46
.LBB9_51:
	xorl	%r10d, %r10d
	jmp	.LBB9_12
.LBB9_53:
	xorl	%r10d, %r10d
.LBB9_10:
	vmovups	5120(%r14,%r10,8), %zmm0
	vmovups	5184(%r14,%r10,8), %zmm1
	vmovups	5248(%r14,%r10,8), %zmm2
	vmovups	5312(%r14,%r10,8), %zmm3
	vmovups	%zmm0, 7680(%r14,%r10,8)
	vmovups	5376(%r14,%r10,8), %zmm0
	vmovups	%zmm1, 7744(%r14,%r10,8)
	vmovups	5440(%r14,%r10,8), %zmm1
	vmovups	%zmm2, 7808(%r14,%r10,8)
	vmovups	5504(%r14,%r10,8), %zmm2
	vmovups	%zmm3, 7872(%r14,%r10,8)
	vmovups	5568(%r14,%r10,8), %zmm3
	vmovups	%zmm0, 7936(%r14,%r10,8)
	vmovups	5632(%r14,%r10,8), %zmm0
	vmovups	%zmm1, 8000(%r14,%r10,8)
	vmovups	5696(%r14,%r10,8), %zmm1
	vmovups	%zmm2, 8064(%r14,%r10,8)
	vmovups	5760(%r14,%r10,8), %zmm2
	vmovups	%zmm3, 8128(%r14,%r10,8)
	vmovups	%zmm0, 8192(%r14,%r10,8)
	vmovups	%zmm1, 8256(%r14,%r10,8)
	vmovups	%zmm2, 8320(%r14,%r10,8)
	vmovups	5824(%r14,%r10,8), %zmm0
	vmovups	5888(%r14,%r10,8), %zmm1
	vmovupd	5952(%r14,%r10,8), %zmm2
	vmovupd	6016(%r14,%r10,8), %zmm3
	vmovups	%zmm0, 8384(%r14,%r10,8)
	vmovups	6080(%r14,%r10,8), %zmm0
	vmovups	%zmm1, 8448(%r14,%r10,8)
	vmovups	6144(%r14,%r10,8), %zmm1
	vmovups	%zmm1, 8704(%r14,%r10,8)
	vmovupd	%zmm2, 8512(%r14,%r10,8)
	vmovups	6208(%r14,%r10,8), %zmm1
	vmovups	%zmm1, 8768(%r14,%r10,8)
	vmovupd	%zmm3, 8576(%r14,%r10,8)
	vmovupd	6272(%r14,%r10,8), %zmm1
	vmovupd	%zmm1, 8832(%r14,%r10,8)
	vmovups	%zmm0, 8640(%r14,%r10,8)
	vmovupd	6336(%r14,%r10,8), %zmm0
	vmovupd	%zmm0, 8896(%r14,%r10,8)
	subq	$-128, %r10
	testb	$8, %dl
	jne	.LBB9_13
.LBB9_12:
	vmovups	5120(%r14,%r10,8), %zmm0
	vmovups	5184(%r14,%r10,8), %zmm1
	vmovups	5248(%r14,%r10,8), %zmm2
	vmovups	5312(%r14,%r10,8), %zmm3
	vmovups	%zmm0, 7680(%r14,%r10,8)
	vmovups	5376(%r14,%r10,8), %zmm0
	vmovups	%zmm1, 7744(%r14,%r10,8)
	vmovups	5440(%r14,%r10,8), %zmm1
	vmovups	%zmm2, 7808(%r14,%r10,8)
	vmovupd	5504(%r14,%r10,8), %zmm2
	vmovups	%zmm3, 7872(%r14,%r10,8)
	vmovupd	5568(%r14,%r10,8), %zmm3
	vmovups	%zmm0, 7936(%r14,%r10,8)
	vmovups	5632(%r14,%r10,8), %zmm0
	vmovups	%zmm0, 8192(%r14,%r10,8)
	vmovups	%zmm1, 8000(%r14,%r10,8)
	vmovups	5696(%r14,%r10,8), %zmm0
	vmovups	%zmm0, 8256(%r14,%r10,8)
	vmovupd	%zmm2, 8064(%r14,%r10,8)
	vmovupd	5760(%r14,%r10,8), %zmm0
	vmovupd	5824(%r14,%r10,8), %zmm1
	vmovupd	%zmm0, 8320(%r14,%r10,8)
	vmovupd	%zmm3, 8128(%r14,%r10,8)
	vmovupd	%zmm1, 8384(%r14,%r10,8)
	addq	$64, %r10
	testq	%rax, %rax
	je	.LBB9_16
.LBB9_14:
	leaq	7936(%r14,%r10,8), %rsi
	shll	$6, %eax
	xorl	%edx, %edx
	.p2align	4
.LBB9_15:
	vmovupd	-2816(%rsi,%rdx), %zmm0
	vmovupd	-2560(%rsi,%rdx), %zmm1
	vmovupd	%zmm0, -256(%rsi,%rdx)
	vmovupd	%zmm1, (%rsi,%rdx)
	addq	$64, %rdx
	cmpq	%rdx, %rax
	jne	.LBB9_15
.LBB9_16:
	movq	$0, 96(%rsp)
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	movq	776(%rsp), %r15
	movq	64(%rsp), %rdx
	movq	24(%rsp), %r9
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v38B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2824_2924Literal_5bint_5d_2838_29x, %rax
	leaq	104(%rsp), %rdi
	leaq	248(%rsp), %rsi
	pushq	%r15
	.cfi_adjust_cfa_offset 8
	pushq	$38
	.cfi_adjust_cfa_offset 8
	pushq	$24
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r14
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%r13
	.cfi_adjust_cfa_offset 8
	pushq	%r11
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	pushq	552(%rsp)
	.cfi_adjust_cfa_offset 8
	vzeroupper
	callq	*%rax
	addq	$208, %rsp
	.cfi_adjust_cfa_offset -208
	testl	%eax, %eax
	jne	.LBB9_45
	testq	%r12, %r12
	movq	8(%rsp), %r10
	sete	%al
	testq	%r15, %r15
	setle	%cl
	orq	96(%rsp), %r10
	orb	%al, %cl
	jne	.LBB9_60
	vcvtsi2sdq	752(%rsp), %xmm15, %xmm0
	vbroadcastsd	128(%rsp), %zmm1
	vbroadcastsd	176(%rsp), %zmm2
	movl	%r12d, %eax
	andl	$3, %eax
	movabsq	$.LCPI9_1, %rcx
	leaq	7(%r15), %rsi
	vbroadcastsd	%xmm0, %zmm0
	cmpq	$32, %rsi
	jae	.LBB9_61
	xorl	%edx, %edx
	xorl	%edi, %edi
	jmp	.LBB9_57
.LBB9_61:
	movabsq	$.LCPI9_0, %rdi
	vbroadcastsd	(%rcx), %zmm3
	shrq	$5, %rsi
	xorl	%edx, %edx
	vxorpd	%xmm5, %xmm5, %xmm5
	vbroadcastsd	(%rdi), %zmm4
	shlq	$2, %rsi
	xorl	%edi, %edi
	.p2align	4
.LBB9_62:
	vcmpeqpd	12800(%r14,%rdi,8), %zmm0, %k1
	vmulpd	9728(%r14,%rdi,8), %zmm2, %zmm6
	vmulpd	6656(%r14,%rdi,8), %zmm3, %zmm7
	vmulpd	6912(%r14,%rdi,8), %zmm3, %zmm9
	vcmpeqpd	13056(%r14,%rdi,8), %zmm1, %k1 {%k1}
	vcmplepd	%zmm7, %zmm6, %k1 {%k1}
	vmulpd	9984(%r14,%rdi,8), %zmm2, %zmm6
	vcmplepd	%zmm9, %zmm6, %k0 {%k1}
	vcmpgtpd	13568(%r14,%rdi,8), %zmm4, %k1
	vmovupd	%zmm5, 13824(%r14,%rdi,8)
	vmulpd	9792(%r14,%rdi,8), %zmm2, %zmm6
	vmulpd	6720(%r14,%rdi,8), %zmm3, %zmm7
	vmulpd	6976(%r14,%rdi,8), %zmm3, %zmm8
	korb	%k0, %k1, %k0
	vcmpeqpd	12864(%r14,%rdi,8), %zmm0, %k1
	kortestb	%k0, %k0
	vcmpeqpd	13120(%r14,%rdi,8), %zmm1, %k1 {%k1}
	setne	%r11b
	orb	%dl, %r11b
	vcmplepd	%zmm7, %zmm6, %k1 {%k1}
	vmulpd	10048(%r14,%rdi,8), %zmm2, %zmm6
	vcmplepd	%zmm8, %zmm6, %k0 {%k1}
	vcmpgtpd	13632(%r14,%rdi,8), %zmm4, %k1
	vmovupd	%zmm5, 13888(%r14,%rdi,8)
	vmulpd	9856(%r14,%rdi,8), %zmm2, %zmm6
	vmulpd	6784(%r14,%rdi,8), %zmm3, %zmm7
	vmulpd	7040(%r14,%rdi,8), %zmm3, %zmm9
	korb	%k0, %k1, %k0
	vcmpeqpd	12928(%r14,%rdi,8), %zmm0, %k1
	kortestb	%k0, %k0
	vcmpeqpd	13184(%r14,%rdi,8), %zmm1, %k1 {%k1}
	setne	%dl
	vcmplepd	%zmm7, %zmm6, %k1 {%k1}
	vmulpd	10112(%r14,%rdi,8), %zmm2, %zmm6
	vcmplepd	%zmm9, %zmm6, %k0 {%k1}
	vcmpgtpd	13696(%r14,%rdi,8), %zmm4, %k1
	vmovupd	%zmm5, 13952(%r14,%rdi,8)
	vmulpd	9920(%r14,%rdi,8), %zmm2, %zmm6
	vmulpd	6848(%r14,%rdi,8), %zmm3, %zmm7
	vmulpd	7104(%r14,%rdi,8), %zmm3, %zmm8
	korb	%k0, %k1, %k0
	vcmpeqpd	12992(%r14,%rdi,8), %zmm0, %k1
	kortestb	%k0, %k0
	vcmpeqpd	13248(%r14,%rdi,8), %zmm1, %k1 {%k1}
	setne	%r9b
	orb	%dl, %r9b
	orb	%r11b, %r9b
	vcmplepd	%zmm7, %zmm6, %k1 {%k1}
	vmulpd	10176(%r14,%rdi,8), %zmm2, %zmm6
	vcmplepd	%zmm8, %zmm6, %k0 {%k1}
	vcmpgtpd	13760(%r14,%rdi,8), %zmm4, %k1
	vmovupd	%zmm5, 14016(%r14,%rdi,8)
	addq	$32, %rdi
	korb	%k0, %k1, %k0
	kortestb	%k0, %k0
	setne	%dl
	orb	%r9b, %dl
	addq	$-4, %rsi
	jne	.LBB9_62
	testq	%rax, %rax
	je	.LBB9_59
.LBB9_57:
	movabsq	$.LCPI9_0, %r8
	vbroadcastsd	(%rcx), %zmm3
	leaq	13824(%r14,%rdi,8), %rsi
	shll	$6, %eax
	xorl	%ecx, %ecx
	vxorpd	%xmm5, %xmm5, %xmm5
	vbroadcastsd	(%r8), %zmm4
	.p2align	4
.LBB9_58:
	vcmpeqpd	-1024(%rsi,%rcx), %zmm0, %k1
	vmulpd	-4096(%rsi,%rcx), %zmm2, %zmm6
	vmulpd	-7168(%rsi,%rcx), %zmm3, %zmm7
	vmulpd	-6912(%rsi,%rcx), %zmm3, %zmm8
	vcmpeqpd	-768(%rsi,%rcx), %zmm1, %k1 {%k1}
	vcmplepd	%zmm7, %zmm6, %k1 {%k1}
	vmulpd	-3840(%rsi,%rcx), %zmm2, %zmm6
	vcmplepd	%zmm8, %zmm6, %k0 {%k1}
	vcmpgtpd	-256(%rsi,%rcx), %zmm4, %k1
	vmovupd	%zmm5, (%rsi,%rcx)
	korb	%k0, %k1, %k0
	kortestb	%k0, %k0
	setne	%dil
	addq	$64, %rcx
	orb	%dil, %dl
	cmpq	%rcx, %rax
	jne	.LBB9_58
.LBB9_59:
	testb	$1, %dl
	je	.LBB9_60
	movl	%r12d, %r9d
	andl	$7, %r9d
	leaq	7(%r15), %rax
	cmpq	$64, %rax
	jae	.LBB9_22
	xorl	%edx, %edx
	jmp	.LBB9_29
.LBB9_60:
	movq	152(%rsp), %rax
	movq	%r10, (%rax)
	xorl	%eax, %eax
	jmp	.LBB9_46
.LBB9_22:
	leaq	-8(%r12), %rax
	movq	%rax, %rcx
	shrq	$3, %rcx
	je	.LBB9_23
	incq	%rcx
	xorl	%edx, %edx
	andq	$-2, %rcx
	negq	%rcx
	.p2align	4
.LBB9_25:
	vmovups	5632(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, (%rsi,%rdx,8)
	vmovups	5696(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 64(%rsi,%rdx,8)
	vmovups	5760(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 128(%rsi,%rdx,8)
	vmovups	5824(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 192(%rsi,%rdx,8)
	vmovups	5888(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 256(%rsi,%rdx,8)
	vmovups	5952(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 320(%rsi,%rdx,8)
	vmovups	6016(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 384(%rsi,%rdx,8)
	vmovups	6080(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 448(%rsi,%rdx,8)
	vmovups	6144(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 512(%rsi,%rdx,8)
	vmovups	6208(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 576(%rsi,%rdx,8)
	vmovups	6272(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 640(%rsi,%rdx,8)
	vmovups	6336(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 704(%rsi,%rdx,8)
	vmovups	6400(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 768(%rsi,%rdx,8)
	vmovups	6464(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 832(%rsi,%rdx,8)
	vmovups	6528(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	%zmm0, 896(%rsi,%rdx,8)
	vmovupd	6592(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	addq	$2, %rcx
	vmovupd	%zmm0, 960(%rsi,%rdx,8)
	leaq	128(%rdx), %rdx
	jne	.LBB9_25
	testb	$8, %al
	je	.LBB9_27
	jmp	.LBB9_28
.LBB9_23:
	xorl	%edx, %edx
.LBB9_27:
	vmovups	5632(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	%zmm0, (%rax,%rdx,8)
	vmovups	5696(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	%zmm0, 64(%rax,%rdx,8)
	vmovups	5760(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	%zmm0, 128(%rax,%rdx,8)
	vmovups	5824(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	%zmm0, 192(%rax,%rdx,8)
	vmovups	5888(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	%zmm0, 256(%rax,%rdx,8)
	vmovups	5952(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	%zmm0, 320(%rax,%rdx,8)
	vmovups	6016(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	%zmm0, 384(%rax,%rdx,8)
	vmovupd	6080(%r14,%rdx,8), %zmm0
	movq	8(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovupd	%zmm0, 448(%rax,%rdx,8)
	addq	$64, %rdx
.LBB9_28:
	testq	%r9, %r9
	je	.LBB9_31
.LBB9_29:
	leaq	(%rbx,%rdx,8), %rax
	leaq	5632(%r14,%rdx,8), %rcx
	movl	%r9d, %edx
	shll	$6, %edx
	xorl	%esi, %esi
	.p2align	4
.LBB9_30:
	vmovupd	(%rcx,%rsi), %zmm0
	movq	8(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rax, %rdi
	vmovupd	%zmm0, (%rsi,%rdi)
	addq	$64, %rsi
	cmpq	%rsi, %rdx
	jne	.LBB9_30
.LBB9_31:
	leaq	3(%r12), %r13
	leaq	4(%r12), %rax
	xorl	%ecx, %ecx
	movq	%r9, 128(%rsp)
	movq	%r10, 8(%rsp)
	.p2align	4
.LBB9_32:
	vmovupd	5888(%r14,%rcx), %zmm0
	movq	8(%rbp), %rdx
	decq	%rax
	shlq	$8, %rdx
	addq	%rbx, %rdx
	vmovupd	%zmm0, 256(%rcx,%rdx)
	addq	$64, %rcx
	cmpq	$4, %rax
	ja	.LBB9_32
	leaq	112(%rsp), %rdi
	leaq	104(%rsp), %rsi
	movq	$0, 112(%rsp)
	movq	$0, 104(%rsp)
	movq	%rbx, %rdx
	movq	%rbp, %rcx
	movq	%r15, %r8
	vzeroupper
	callq	*56(%rsp)
	cmpq	$64, 72(%rsp)
	movl	%eax, 124(%rsp)
	jae	.LBB9_63
	movq	128(%rsp), %rdi
	xorl	%edx, %edx
	jmp	.LBB9_70
.LBB9_63:
	movq	128(%rsp), %rdi
	leaq	-8(%r12), %rax
	movq	%rax, %rcx
	shrq	$3, %rcx
	je	.LBB9_64
	incq	%rcx
	xorl	%edx, %edx
	andq	$-2, %rcx
	negq	%rcx
	.p2align	4
.LBB9_66:
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7680(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	64(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7744(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	128(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7808(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	192(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7872(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	256(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7936(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	320(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8000(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	384(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8064(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	448(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8128(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	512(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8192(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	576(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8256(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	640(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8320(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	704(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8384(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	768(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8448(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	832(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8512(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	vmovups	896(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8576(%r14,%rdx,8)
	movq	16(%rbp), %rsi
	shlq	$8, %rsi
	addq	%rbx, %rsi
	addq	$2, %rcx
	vmovupd	960(%rsi,%rdx,8), %zmm0
	vmovupd	%zmm0, 8640(%r14,%rdx,8)
	leaq	128(%rdx), %rdx
	jne	.LBB9_66
	testb	$8, %al
	je	.LBB9_68
	jmp	.LBB9_69
.LBB9_64:
	xorl	%edx, %edx
.LBB9_68:
	movq	16(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7680(%r14,%rdx,8)
	movq	16(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	64(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7744(%r14,%rdx,8)
	movq	16(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	128(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7808(%r14,%rdx,8)
	movq	16(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	192(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7872(%r14,%rdx,8)
	movq	16(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	256(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7936(%r14,%rdx,8)
	movq	16(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	320(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 8000(%r14,%rdx,8)
	movq	16(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovups	384(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 8064(%r14,%rdx,8)
	movq	16(%rbp), %rax
	shlq	$8, %rax
	addq	%rbx, %rax
	vmovupd	448(%rax,%rdx,8), %zmm0
	vmovupd	%zmm0, 8128(%r14,%rdx,8)
	addq	$64, %rdx
.LBB9_69:
	testq	%rdi, %rdi
	je	.LBB9_72
.LBB9_70:
	leaq	7680(%r14,%rdx,8), %rax
	leaq	(%rbx,%rdx,8), %rcx
	movl	%edi, %edx
	shll	$6, %edx
	xorl	%esi, %esi
	.p2align	4
.LBB9_71:
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rcx, %rdi
	vmovupd	(%rsi,%rdi), %zmm0
	vmovupd	%zmm0, (%rax,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rdx
	jne	.LBB9_71
.LBB9_72:
	leaq	256(%rbx), %r15
	leaq	4(%r12), %rax
	xorl	%ecx, %ecx
	.p2align	4
.LBB9_73:
	movq	16(%rbp), %rdx
	decq	%rax
	shlq	$8, %rdx
	addq	%rbx, %rdx
	vmovupd	256(%rcx,%rdx), %zmm0
	vmovupd	%zmm0, 7936(%r14,%rcx)
	addq	$64, %rcx
	cmpq	$4, %rax
	ja	.LBB9_73
	subq	$8, %rsp
	.cfi_adjust_cfa_offset 8
	vmovsd	168(%rsp), %xmm0
	movq	72(%rsp), %rdx
	movq	56(%rsp), %rcx
	movq	24(%rsp), %r8
	movq	360(%rsp), %r9
	leaq	240(%rsp), %rdi
	leaq	232(%rsp), %rsi
	pushq	776(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	760(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbp
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	688(%rsp)
	.cfi_adjust_cfa_offset 8
	pushq	%rbx
	.cfi_adjust_cfa_offset 8
	movabsq	$_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx, %rax
	vzeroupper
	callq	*%rax
	addq	$336, %rsp
	.cfi_adjust_cfa_offset -336
	testl	%eax, %eax
	je	.LBB9_76
	cmpl	$-2, %eax
	jne	.LBB9_45
.LBB9_76:
	movq	768(%rsp), %r8
	leaq	112(%rsp), %rdi
	leaq	104(%rsp), %rsi
	movq	$0, 112(%rsp)
	movq	$0, 104(%rsp)
	movq	%rbx, %rdx
	movq	%rbp, %rcx
	callq	*56(%rsp)
	cmpq	$64, 72(%rsp)
	jae	.LBB9_78
	vmovsd	80(%rsp), %xmm2
	movq	8(%rsp), %r8
	movq	128(%rsp), %r9
	xorl	%esi, %esi
	jmp	.LBB9_85
.LBB9_45:
	movq	24(%rsp), %rcx
	movq	$0, (%rcx)
.LBB9_46:
	addq	$296, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.LBB9_78:
	.cfi_def_cfa_offset 352
	vmovsd	80(%rsp), %xmm2
	movq	128(%rsp), %r9
	leaq	-8(%r12), %rcx
	movq	%rcx, %rdx
	shrq	$3, %rdx
	je	.LBB9_79
	incq	%rdx
	xorl	%esi, %esi
	andq	$-2, %rdx
	negq	%rdx
	.p2align	4
.LBB9_81:
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8192(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	64(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8256(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	128(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8320(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	192(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8384(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	256(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8448(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	320(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8512(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	384(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8576(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	448(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8640(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	512(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8704(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	576(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8768(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	640(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8832(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	704(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8896(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	768(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 8960(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	832(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 9024(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	vmovups	896(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 9088(%r14,%rsi,8)
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rbx, %rdi
	addq	$2, %rdx
	vmovupd	960(%rdi,%rsi,8), %zmm0
	vmovupd	%zmm0, 9152(%r14,%rsi,8)
	leaq	128(%rsi), %rsi
	jne	.LBB9_81
	movq	8(%rsp), %r8
	testb	$8, %cl
	je	.LBB9_83
	jmp	.LBB9_84
.LBB9_79:
	movq	8(%rsp), %r8
	xorl	%esi, %esi
.LBB9_83:
	movq	16(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 8192(%r14,%rsi,8)
	movq	16(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	64(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 8256(%r14,%rsi,8)
	movq	16(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	128(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 8320(%r14,%rsi,8)
	movq	16(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	192(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 8384(%r14,%rsi,8)
	movq	16(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	256(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 8448(%r14,%rsi,8)
	movq	16(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	320(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 8512(%r14,%rsi,8)
	movq	16(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovups	384(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 8576(%r14,%rsi,8)
	movq	16(%rbp), %rcx
	shlq	$8, %rcx
	addq	%rbx, %rcx
	vmovupd	448(%rcx,%rsi,8), %zmm0
	vmovupd	%zmm0, 8640(%r14,%rsi,8)
	addq	$64, %rsi
.LBB9_84:
	testq	%r9, %r9
	je	.LBB9_87
.LBB9_85:
	leaq	8192(%r14,%rsi,8), %rcx
	leaq	(%rbx,%rsi,8), %rdx
	shll	$6, %r9d
	xorl	%esi, %esi
	.p2align	4
.LBB9_86:
	movq	16(%rbp), %rdi
	shlq	$8, %rdi
	addq	%rdx, %rdi
	vmovupd	(%rsi,%rdi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %r9
	jne	.LBB9_86
.LBB9_87:
	leaq	8448(%r14), %rcx
	addq	$4, %r12
	.p2align	4
.LBB9_88:
	movq	16(%rbp), %rdx
	decq	%r12
	shlq	$8, %rdx
	vmovupd	(%r15,%rdx), %zmm0
	addq	$64, %r15
	vmovupd	%zmm0, (%rcx)
	addq	$64, %rcx
	cmpq	$4, %r12
	ja	.LBB9_88
	leaq	9472(%r14), %rcx
	.p2align	4
.LBB9_90:
	vmovupd	-5888(%rcx), %zmm0
	vmovupd	-5632(%rcx), %zmm1
	decq	%r13
	vaddpd	-4352(%rcx), %zmm0, %zmm0
	vsubpd	-1280(%rcx), %zmm0, %zmm0
	vsubpd	-1792(%rcx), %zmm0, %zmm0
	vmovupd	%zmm0, -256(%rcx)
	vaddpd	-4096(%rcx), %zmm1, %zmm0
	vsubpd	-1024(%rcx), %zmm0, %zmm0
	vsubpd	-1536(%rcx), %zmm0, %zmm0
	vmovupd	%zmm0, (%rcx)
	addq	$64, %rcx
	cmpq	$3, %r13
	ja	.LBB9_90
	orl	124(%rsp), %eax
	movq	48(%rsp), %rcx
	movq	64(%rsp), %r13
	movq	400(%rsp), %r10
	movq	416(%rsp), %r11
	movq	424(%rsp), %r15
	movq	440(%rsp), %r12
	vmovapd	%xmm2, %xmm0
	cltq
	orq	%rax, %r8
	movq	392(%rsp), %rax
	movq	%r8, 8(%rsp)
	movq	16(%rsp), %r8
	jmp	.LBB9_36
.LBB9_44:
	movq	$0, (%r14)
	jmp	.LBB9_46
.Lfunc_end9:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9attemptedB3v48B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxddx, .Lfunc_end9-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9attemptedB3v48B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxddx
	.cfi_endproc

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI10_0:
	.quad	0x3fcb0cb174df99c7
.LCPI10_1:
	.quad	0x3fe0000000000000
.LCPI10_2:
	.quad	0x403e000000000000
.LCPI10_3:
	.quad	0x4008000000000000
.LCPI10_4:
	.quad	0x3fd0000000000000
.LCPI10_5:
	.quad	0x4018000000000000
.LCPI10_6:
	.quad	0x3ff0000000000000
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7carriedB3v55B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxdxxbx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7carriedB3v55B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxdxxbx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7carriedB3v55B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxdxxbx:
	pushq	%rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	subq	$96, %rsp
	movq	304(%rsp), %rax
	movq	%rdi, -64(%rsp)
	leaq	7(%rax), %r13
	shrq	$3, %r13
	testq	%rax, %rax
	setle	%al
	testq	%r13, %r13
	sete	%cl
	orb	%al, %cl
	je	.LBB10_1
.LBB10_38:
	movq	-64(%rsp), %rax
	movq	$0, (%rax)
	xorl	%eax, %eax
	addq	$96, %rsp
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.LBB10_1:
	movq	288(%rsp), %rax
	movq	280(%rsp), %rdi
	movabsq	$.LCPI10_0, %rcx
	movq	264(%rsp), %r12
	vmulsd	%xmm0, %xmm0, %xmm6
	movq	272(%rsp), %rdx
	vbroadcastsd	%xmm0, %zmm7
	movq	224(%rsp), %rbx
	movq	168(%rsp), %rsi
	vxorpd	%xmm17, %xmm17, %xmm17
	vmulsd	(%rcx), %xmm0, %xmm9
	movabsq	$.LCPI10_2, %rcx
	vdivsd	(%rcx), %xmm6, %xmm6
	movabsq	$.LCPI10_3, %rcx
	vdivsd	(%rcx), %xmm0, %xmm13
	movabsq	$.LCPI10_4, %rcx
	vmulsd	(%rcx), %xmm0, %xmm12
	movabsq	$9223372036854775800, %rcx
	vcvtsi2sd	%rax, %xmm15, %xmm1
	addq	%rdi, %rax
	vcvtsi2sd	%rdi, %xmm15, %xmm5
	movq	%r12, %r8
	andq	%rcx, %r8
	leaq	-1(%r12), %r11
	movq	%rdx, %r10
	shlq	$8, %r10
	movq	%r12, %rdi
	movq	%rsi, %r9
	shlq	$9, %rdi
	movl	%r12d, %ebp
	movl	%r12d, %r15d
	andl	$7, %ebp
	andl	$3, %r15d
	shlq	$5, %r9
	vcvtsi2sd	%rax, %xmm15, %xmm3
	movabsq	$.LCPI10_1, %rax
	movq	%r8, -120(%rsp)
	leaq	4(%rcx), %r8
	orq	$6, %rcx
	movq	%r11, -8(%rsp)
	movq	%rbp, -88(%rsp)
	shll	$9, %ebp
	movq	%r15, 64(%rsp)
	shll	$9, %r15d
	movq	%rdi, 88(%rsp)
	movq	%r9, 8(%rsp)
	vmovsd	(%rax), %xmm14
	andq	%r12, %r8
	andq	%rdx, %rcx
	shlq	$9, %rdx
	movq	%r15, (%rsp)
	movq	%rbp, -48(%rsp)
	movq	%r8, 56(%rsp)
	addq	$-4, %r8
	movq	%r8, %r14
	movq	%r8, -96(%rsp)
	shlq	$9, %r8
	shrq	$2, %r14
	vbroadcastsd	%xmm5, %zmm2
	vbroadcastsd	%xmm1, %zmm1
	addq	$-2048, %r8
	incq	%r14
	vbroadcastsd	%xmm3, %zmm3
	vsubsd	%xmm9, %xmm0, %xmm11
	andq	$-4096, %r8
	andq	$-2, %r14
	addq	$4096, %r8
	movq	%r14, 24(%rsp)
	movq	%r8, 16(%rsp)
	imulq	$456, %rsi, %r8
	vbroadcastsd	%xmm12, %zmm12
	vmulsd	%xmm5, %xmm14, %xmm4
	vmulsd	%xmm14, %xmm9, %xmm8
	vmulsd	%xmm14, %xmm11, %xmm10
	vmulsd	%xmm0, %xmm14, %xmm0
	vbroadcastsd	(%rax), %zmm14
	movabsq	$.LCPI10_5, %rax
	vaddsd	%xmm5, %xmm5, %xmm5
	vbroadcastsd	%xmm9, %zmm9
	vbroadcastsd	%xmm11, %zmm11
	vbroadcastsd	(%rax), %zmm15
	movq	%r11, %rax
	orq	$1, %rax
	movq	%r8, 80(%rsp)
	imulq	$472, %rsi, %r8
	imulq	$488, %rsi, %rsi
	movq	%rax, -16(%rsp)
	leaq	768(%r10), %rax
	imulq	%rcx, %rax
	addq	$-2, %rcx
	vbroadcastsd	%xmm4, %zmm4
	vbroadcastsd	%xmm5, %zmm5
	vbroadcastsd	%xmm8, %zmm8
	vbroadcastsd	%xmm10, %zmm10
	vbroadcastsd	%xmm0, %zmm0
	movq	%rcx, -104(%rsp)
	shrq	%rcx
	movq	%r8, -32(%rsp)
	movq	%rsi, -40(%rsp)
	incq	%rcx
	addq	%rbx, %rax
	andq	$-2, %rcx
	movq	%rax, 72(%rsp)
	movq	%r11, %rax
	andq	$-2, %rax
	movq	%rbx, %r11
	leaq	14592(%rdi), %rbx
	vbroadcastsd	%xmm6, %zmm6
	movq	%rcx, -56(%rsp)
	movq	%rax, -24(%rsp)
	movabsq	$.LCPI10_6, %rax
	vbroadcastsd	%xmm13, %zmm13
	movq	%rbx, 32(%rsp)
	vmovsd	(%rax), %xmm16
	movq	152(%rsp), %rax
	leaq	14592(%rax,%rdi), %r8
	leaq	14848(%rax), %rcx
	leaq	17408(%rax,%rdi), %r14
	leaq	22272(%rax,%rdi), %rbx
	leaq	18432(%rax), %rsi
	movq	%rcx, -128(%rsp)
	movq	%r8, -112(%rsp)
	leaq	22528(%rax,%rdi), %r8
	leaq	14848(%rax,%rdi), %rax
	movq	%rax, -80(%rsp)
	xorl	%eax, %eax
	jmp	.LBB10_2
	.p2align	4
.LBB10_37:
	addq	$64, -128(%rsp)
	addq	$64, -112(%rsp)
	addq	$64, -80(%rsp)
	addq	$8, %rax
	addq	$64, %r14
	addq	$64, %rbx
	addq	$64, %rsi
	addq	$64, %r8
	addq	$64, %r11
	cmpq	$1, %r13
	leaq	-1(%r13), %r13
	jbe	.LBB10_38
.LBB10_2:
	movq	152(%rsp), %rcx
	cmpq	$2, 280(%rsp)
	vmovupd	12800(%rcx,%rax,8), %zmm19
	vmovupd	13056(%rcx,%rax,8), %zmm18
	leaq	(%rcx,%rax,8), %rdi
	vcmpeqpd	%zmm1, %zmm19, %k1
	vcmpeqpd	%zmm2, %zmm18, %k2 {%k1}
	kmovq	%k2, %k1
	jl	.LBB10_4
	vcmpltpd	13824(%rdi), %zmm14, %k1 {%k2}
.LBB10_4:
	kortestb	%k1, %k1
	vmovapd	%zmm3, %zmm19 {%k1}
	vmovupd	%zmm19, 12800(%rdi)
	vmovapd	%zmm4, %zmm18 {%k2}
	vmovupd	%zmm18, 13056(%rdi)
	vmovupd	%zmm5, 13312(%rdi) {%k1}
	je	.LBB10_37
	vmovupd	4096(%rcx,%rax,8), %zmm18
	vmovupd	4608(%rcx,%rax,8), %zmm20
	vmovupd	4352(%rcx,%rax,8), %zmm19
	vmovupd	4864(%rcx,%rax,8), %zmm23
	movq	%r11, -72(%rsp)
	vsubpd	%zmm18, %zmm20, %zmm21
	vaddpd	%zmm18, %zmm18, %zmm18
	vaddpd	3584(%rcx,%rax,8), %zmm18, %zmm18
	vaddpd	%zmm20, %zmm20, %zmm20
	vsubpd	%zmm19, %zmm23, %zmm24
	vmulpd	2560(%rcx,%rax,8), %zmm21, %zmm22
	vmulpd	2816(%rcx,%rax,8), %zmm24, %zmm25
	vaddpd	%zmm19, %zmm19, %zmm19
	vaddpd	%zmm18, %zmm20, %zmm18
	vaddpd	5120(%rcx,%rax,8), %zmm18, %zmm18
	vaddpd	%zmm25, %zmm22, %zmm22
	vmulpd	%zmm22, %zmm6, %zmm20
	vdivpd	%zmm15, %zmm18, %zmm18
	vaddpd	%zmm18, %zmm20, %zmm18
	vaddpd	8704(%rcx,%rax,8), %zmm18, %zmm18
	vmulpd	%zmm18, %zmm7, %zmm18
	vaddpd	(%rcx,%rax,8), %zmm18, %zmm18
	vmovupd	%zmm18, (%rcx,%rax,8) {%k1}
	vaddpd	3840(%rcx,%rax,8), %zmm19, %zmm19
	vmulpd	3072(%rcx,%rax,8), %zmm21, %zmm18
	vaddpd	%zmm23, %zmm23, %zmm21
	vmulpd	3328(%rcx,%rax,8), %zmm24, %zmm20
	vaddpd	%zmm19, %zmm21, %zmm19
	vaddpd	5376(%rcx,%rax,8), %zmm19, %zmm19
	vaddpd	%zmm20, %zmm18, %zmm18
	vmulpd	%zmm18, %zmm6, %zmm18
	vdivpd	%zmm15, %zmm19, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vaddpd	8960(%rcx,%rax,8), %zmm18, %zmm18
	vmulpd	%zmm18, %zmm7, %zmm18
	vaddpd	256(%rcx,%rax,8), %zmm18, %zmm18
	vmovupd	%zmm18, 256(%rcx,%rax,8) {%k1}
	testq	%r12, %r12
	jle	.LBB10_12
	movq	80(%rsp), %r9
	vcvttsd2si	(%rcx,%r9), %rcx
	movq	88(%rsp), %r9
	testq	%rcx, %rcx
	sete	%r11b
	kmovd	%r11d, %k2
	movq	%rcx, %r11
	shlq	$8, %r11
	cmpq	$1, %rcx
	vmovupd	2560(%rdi,%r11), %zmm20
	vmovupd	1536(%rdi,%r11), %zmm19
	vmovsd	%xmm16, %xmm16, %xmm18 {%k2} {z}
	sete	%cl
	vbroadcastsd	%xmm18, %zmm18
	kmovd	%ecx, %k2
	vmulpd	%zmm20, %zmm8, %zmm21
	vmulpd	%zmm20, %zmm10, %zmm20
	vaddpd	%zmm21, %zmm19, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm9, %zmm21
	vmulpd	%zmm19, %zmm11, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm21, 14592(%rdi,%r9)
	vmovupd	%zmm18, 15104(%rdi,%r9)
	vmovsd	%xmm16, %xmm16, %xmm18 {%k2} {z}
	vmovupd	3072(%rdi,%r11), %zmm20
	vmovupd	2048(%rdi,%r11), %zmm19
	vbroadcastsd	%xmm18, %zmm18
	vmulpd	%zmm20, %zmm8, %zmm21
	vmulpd	%zmm20, %zmm10, %zmm20
	vaddpd	%zmm21, %zmm19, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm9, %zmm21
	vmulpd	%zmm19, %zmm11, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm21, 14848(%rdi,%r9)
	vmovupd	%zmm18, 15360(%rdi,%r9)
	cmpq	$1, %r12
	je	.LBB10_12
	movl	$1, %ecx
	cmpq	$2, %r12
	je	.LBB10_11
	movq	-24(%rsp), %r12
	movq	%r14, 40(%rsp)
	movq	%r14, %rcx
	movq	152(%rsp), %r11
	movq	8(%rsp), %r15
	movq	-32(%rsp), %r14
	movq	-40(%rsp), %rbp
	movq	%r13, 48(%rsp)
	.p2align	4
.LBB10_9:
	vcvttsd2si	(%r11,%r14), %r13
	testq	%r13, %r13
	sete	%r9b
	kmovd	%r9d, %k2
	movq	%r13, %r9
	shlq	$8, %r9
	cmpq	$1, %r13
	vmovupd	2560(%rdi,%r9), %zmm20
	vmovupd	1536(%rdi,%r9), %zmm19
	vmovsd	%xmm16, %xmm16, %xmm18 {%k2} {z}
	sete	%r13b
	vbroadcastsd	%xmm18, %zmm18
	kmovd	%r13d, %k2
	vmulpd	%zmm20, %zmm8, %zmm21
	vmulpd	%zmm20, %zmm10, %zmm20
	vaddpd	%zmm21, %zmm19, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm9, %zmm21
	vmulpd	%zmm19, %zmm11, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm21, -1792(%rcx)
	vmovupd	%zmm18, -1280(%rcx)
	vmovsd	%xmm16, %xmm16, %xmm18 {%k2} {z}
	vmovupd	3072(%rdi,%r9), %zmm20
	vmovupd	2048(%rdi,%r9), %zmm19
	vbroadcastsd	%xmm18, %zmm18
	vmulpd	%zmm20, %zmm8, %zmm21
	vmulpd	%zmm20, %zmm10, %zmm20
	vaddpd	%zmm21, %zmm19, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm9, %zmm21
	vmulpd	%zmm19, %zmm11, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm21, -1536(%rcx)
	vmovupd	%zmm18, -1024(%rcx)
	vcvttsd2si	(%r11,%rbp), %r9
	testq	%r9, %r9
	sete	%r13b
	kmovd	%r13d, %k2
	movq	%r9, %r13
	shlq	$8, %r13
	cmpq	$1, %r9
	vmovupd	2560(%rdi,%r13), %zmm20
	vmovupd	1536(%rdi,%r13), %zmm19
	vmovsd	%xmm16, %xmm16, %xmm18 {%k2} {z}
	sete	%r9b
	addq	%r15, %r11
	vbroadcastsd	%xmm18, %zmm18
	kmovd	%r9d, %k2
	vmulpd	%zmm20, %zmm8, %zmm21
	vmulpd	%zmm20, %zmm10, %zmm20
	vaddpd	%zmm21, %zmm19, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm9, %zmm21
	vmulpd	%zmm19, %zmm11, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm21, -768(%rcx)
	vmovupd	%zmm18, -256(%rcx)
	vmovsd	%xmm16, %xmm16, %xmm18 {%k2} {z}
	vmovupd	3072(%rdi,%r13), %zmm20
	vmovupd	2048(%rdi,%r13), %zmm19
	vbroadcastsd	%xmm18, %zmm18
	vmulpd	%zmm20, %zmm8, %zmm21
	vmulpd	%zmm20, %zmm10, %zmm20
	vaddpd	%zmm21, %zmm19, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm9, %zmm21
	vmulpd	%zmm19, %zmm11, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm21, -512(%rcx)
	vmovupd	%zmm18, (%rcx)
	addq	$2048, %rcx
	addq	$-2, %r12
	jne	.LBB10_9
	movq	-16(%rsp), %rcx
	testb	$1, -8(%rsp)
	movq	48(%rsp), %r13
	movq	264(%rsp), %r12
	movq	(%rsp), %r15
	movq	40(%rsp), %r14
	movq	-48(%rsp), %rbp
	je	.LBB10_12
.LBB10_11:
	movq	32(%rsp), %r9
	movq	152(%rsp), %r12
	leaq	(%rdi,%r9), %r11
	leaq	57(%rcx,%rcx), %r9
	imulq	168(%rsp), %r9
	vcvttsd2si	(%r12,%r9,8), %r9
	testq	%r9, %r9
	sete	%r12b
	shlq	$10, %rcx
	kmovd	%r12d, %k2
	movq	%r9, %r12
	shlq	$8, %r12
	cmpq	$1, %r9
	vmovupd	2560(%rdi,%r12), %zmm20
	vmovupd	1536(%rdi,%r12), %zmm19
	vmovsd	%xmm16, %xmm16, %xmm18 {%k2} {z}
	sete	%r9b
	vbroadcastsd	%xmm18, %zmm18
	kmovd	%r9d, %k2
	vmulpd	%zmm20, %zmm8, %zmm21
	vmulpd	%zmm20, %zmm10, %zmm20
	vaddpd	%zmm21, %zmm19, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm9, %zmm21
	vmulpd	%zmm19, %zmm11, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm21, (%r11,%rcx)
	vmovupd	%zmm18, 512(%r11,%rcx)
	vmovsd	%xmm16, %xmm16, %xmm18 {%k2} {z}
	vmovupd	3072(%rdi,%r12), %zmm20
	vmovupd	2048(%rdi,%r12), %zmm19
	movq	264(%rsp), %r12
	vbroadcastsd	%xmm18, %zmm18
	vmulpd	%zmm20, %zmm8, %zmm21
	vmulpd	%zmm20, %zmm10, %zmm20
	vaddpd	%zmm21, %zmm19, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm9, %zmm21
	vmulpd	%zmm19, %zmm11, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm21, 256(%r11,%rcx)
	vmovupd	%zmm18, 768(%r11,%rcx)
.LBB10_12:
	vmovupd	1536(%rdi), %zmm18
	vmovupd	2560(%rdi), %zmm19
	vmovupd	2816(%rdi), %zmm23
	vmovupd	2048(%rdi), %zmm24
	vmovupd	2304(%rdi), %zmm29
	movabsq	$.LCPI10_6, %rcx
	vmulpd	%zmm17, %zmm18, %zmm20
	vmulpd	%zmm19, %zmm18, %zmm21
	vmulpd	%zmm24, %zmm23, %zmm25
	vmulpd	%zmm19, %zmm19, %zmm22
	vmulpd	%zmm29, %zmm23, %zmm30
	vmulpd	%zmm23, %zmm19, %zmm28
	vaddpd	%zmm21, %zmm20, %zmm21
	vaddpd	%zmm22, %zmm20, %zmm22
	vaddpd	%zmm28, %zmm20, %zmm28
	vaddpd	%zmm25, %zmm21, %zmm21
	vmovupd	3072(%rdi), %zmm25
	vmulpd	%zmm25, %zmm23, %zmm26
	vaddpd	%zmm26, %zmm22, %zmm22
	vmulpd	%zmm22, %zmm12, %zmm22
	vaddpd	%zmm22, %zmm21, %zmm21
	vmovupd	1792(%rdi), %zmm22
	vmulpd	%zmm21, %zmm13, %zmm21
	vaddpd	%zmm21, %zmm19, %zmm21
	vmulpd	%zmm22, %zmm19, %zmm27
	vmulpd	%zmm25, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm0, %zmm21
	vaddpd	%zmm27, %zmm20, %zmm27
	vaddpd	%zmm19, %zmm20, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm21
	vmulpd	%zmm25, %zmm18, %zmm18
	vaddpd	%zmm30, %zmm27, %zmm27
	vmovupd	3328(%rdi), %zmm30
	vmulpd	%zmm21, %zmm7, %zmm21
	vaddpd	%zmm18, %zmm20, %zmm18
	vmulpd	%zmm30, %zmm23, %zmm31
	vaddpd	%zmm31, %zmm28, %zmm28
	vmulpd	%zmm28, %zmm12, %zmm28
	vaddpd	%zmm28, %zmm27, %zmm27
	vmulpd	%zmm27, %zmm13, %zmm27
	vaddpd	%zmm27, %zmm23, %zmm23
	vbroadcastsd	(%rcx), %zmm27
	vmulpd	%zmm23, %zmm0, %zmm23
	vaddpd	%zmm23, %zmm22, %zmm23
	vmulpd	%zmm23, %zmm7, %zmm28
	vmulpd	%zmm30, %zmm25, %zmm23
	vaddpd	%zmm27, %zmm21, %zmm31
	vmulpd	%zmm30, %zmm24, %zmm21
	vaddpd	%zmm23, %zmm19, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm18
	vmulpd	%zmm22, %zmm25, %zmm21
	vmulpd	%zmm30, %zmm30, %zmm22
	vmovupd	%zmm28, 10496(%rdi)
	vmovupd	%zmm31, 10240(%rdi)
	vmulpd	%zmm19, %zmm12, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vmulpd	%zmm18, %zmm13, %zmm18
	vaddpd	%zmm18, %zmm25, %zmm18
	vmulpd	%zmm18, %zmm0, %zmm18
	vaddpd	%zmm18, %zmm24, %zmm18
	vmulpd	%zmm18, %zmm7, %zmm19
	vaddpd	%zmm21, %zmm20, %zmm18
	vaddpd	%zmm26, %zmm20, %zmm20
	vmulpd	%zmm30, %zmm29, %zmm21
	vaddpd	%zmm22, %zmm20, %zmm20
	vaddpd	%zmm21, %zmm18, %zmm18
	vmovupd	%zmm19, 10752(%rdi)
	vmulpd	%zmm20, %zmm12, %zmm20
	vaddpd	%zmm20, %zmm18, %zmm18
	vmulpd	%zmm18, %zmm13, %zmm18
	vaddpd	%zmm18, %zmm30, %zmm18
	vmulpd	%zmm18, %zmm0, %zmm18
	vaddpd	%zmm18, %zmm29, %zmm18
	vmulpd	%zmm18, %zmm7, %zmm18
	vaddpd	%zmm27, %zmm18, %zmm20
	vmovupd	%zmm20, 11008(%rdi)
	vmovupd	512(%rdi), %zmm24
	vmovupd	1024(%rdi), %zmm22
	vmovupd	768(%rdi), %zmm21
	vmulpd	%zmm28, %zmm22, %zmm23
	vmulpd	%zmm31, %zmm24, %zmm18
	vmulpd	%zmm19, %zmm24, %zmm27
	vmulpd	%zmm20, %zmm22, %zmm22
	vmulpd	%zmm19, %zmm21, %zmm29
	vaddpd	%zmm23, %zmm18, %zmm25
	vmulpd	%zmm21, %zmm31, %zmm23
	vaddpd	%zmm22, %zmm27, %zmm22
	vmovupd	%zmm25, 2560(%rdi)
	vmovupd	1280(%rdi), %zmm18
	vmulpd	%zmm18, %zmm28, %zmm26
	vmulpd	%zmm20, %zmm18, %zmm27
	vaddpd	%zmm26, %zmm23, %zmm26
	vaddpd	%zmm27, %zmm29, %zmm23
	vmulpd	%zmm25, %zmm31, %zmm29
	vmulpd	%zmm26, %zmm28, %zmm28
	vmovupd	%zmm26, 2816(%rdi)
	vmovupd	%zmm22, 3072(%rdi)
	vmovupd	%zmm23, 3328(%rdi)
	vaddpd	%zmm28, %zmm29, %zmm27
	testq	%r12, %r12
	jle	.LBB10_53
	cmpq	$8, %r12
	jae	.LBB10_39
	xorl	%ecx, %ecx
	jmp	.LBB10_43
	.p2align	4
.LBB10_53:
	vmulpd	%zmm25, %zmm19, %zmm25
	vmulpd	%zmm26, %zmm20, %zmm26
	vmulpd	%zmm22, %zmm19, %zmm19
	vmulpd	%zmm23, %zmm20, %zmm20
	vmovapd	%zmm27, %zmm24 {%k1}
	vmovupd	%zmm24, 512(%rdi)
	vaddpd	%zmm26, %zmm25, %zmm21 {%k1}
	vaddpd	%zmm20, %zmm19, %zmm19
	vmovupd	%zmm21, 768(%rdi)
	vmovupd	%zmm21, 1024(%rdi)
	jmp	.LBB10_27
.LBB10_39:
	movq	-120(%rsp), %rcx
	xorl	%r11d, %r11d
	.p2align	4
.LBB10_40:
	vmovupd	-7680(%rbx,%r11,2), %zmm28
	vmovupd	-7168(%rbx,%r11,2), %zmm29
	vmulpd	-3584(%rsi,%r11), %zmm0, %zmm31
	vmulpd	-3072(%rsi,%r11), %zmm0, %zmm30
	vmulpd	%zmm28, %zmm28, %zmm28
	vmulpd	%zmm29, %zmm29, %zmm29
	vaddpd	%zmm29, %zmm28, %zmm28
	vmovupd	-6656(%rbx,%r11,2), %zmm29
	vmulpd	%zmm28, %zmm31, %zmm28
	vmulpd	-2560(%rsi,%r11), %zmm0, %zmm31
	vaddpd	%zmm28, %zmm27, %zmm27
	vmulpd	%zmm29, %zmm29, %zmm28
	vmovupd	-6144(%rbx,%r11,2), %zmm29
	vmulpd	%zmm29, %zmm29, %zmm29
	vaddpd	%zmm29, %zmm28, %zmm28
	vmovupd	-5120(%rbx,%r11,2), %zmm29
	vmulpd	%zmm28, %zmm30, %zmm28
	vmovupd	-5632(%rbx,%r11,2), %zmm30
	vaddpd	%zmm28, %zmm27, %zmm27
	vmulpd	%zmm29, %zmm29, %zmm29
	vmulpd	%zmm30, %zmm30, %zmm28
	vmulpd	-2048(%rsi,%r11), %zmm0, %zmm30
	vaddpd	%zmm29, %zmm28, %zmm28
	vmovupd	-4608(%rbx,%r11,2), %zmm29
	vmulpd	%zmm28, %zmm31, %zmm28
	vmulpd	-1536(%rsi,%r11), %zmm0, %zmm31
	vaddpd	%zmm28, %zmm27, %zmm27
	vmulpd	%zmm29, %zmm29, %zmm28
	vmovupd	-4096(%rbx,%r11,2), %zmm29
	vmulpd	%zmm29, %zmm29, %zmm29
	vaddpd	%zmm29, %zmm28, %zmm28
	vmovupd	-3072(%rbx,%r11,2), %zmm29
	vmulpd	%zmm28, %zmm30, %zmm28
	vmovupd	-3584(%rbx,%r11,2), %zmm30
	vaddpd	%zmm28, %zmm27, %zmm27
	vmulpd	%zmm29, %zmm29, %zmm29
	vmulpd	%zmm30, %zmm30, %zmm28
	vmulpd	-1024(%rsi,%r11), %zmm0, %zmm30
	vaddpd	%zmm29, %zmm28, %zmm28
	vmovupd	-2560(%rbx,%r11,2), %zmm29
	vmulpd	%zmm28, %zmm31, %zmm28
	vmulpd	-512(%rsi,%r11), %zmm0, %zmm31
	vaddpd	%zmm28, %zmm27, %zmm27
	vmulpd	%zmm29, %zmm29, %zmm28
	vmovupd	-2048(%rbx,%r11,2), %zmm29
	vmulpd	%zmm29, %zmm29, %zmm29
	vaddpd	%zmm29, %zmm28, %zmm28
	vmovupd	-1024(%rbx,%r11,2), %zmm29
	vmulpd	%zmm28, %zmm30, %zmm28
	vmovupd	-1536(%rbx,%r11,2), %zmm30
	vaddpd	%zmm28, %zmm27, %zmm27
	vmulpd	%zmm29, %zmm29, %zmm29
	vmulpd	%zmm30, %zmm30, %zmm28
	vmulpd	(%rsi,%r11), %zmm0, %zmm30
	vaddpd	%zmm29, %zmm28, %zmm28
	vmovupd	-512(%rbx,%r11,2), %zmm29
	vmulpd	%zmm28, %zmm31, %zmm28
	vaddpd	%zmm28, %zmm27, %zmm27
	vmulpd	%zmm29, %zmm29, %zmm28
	vmovupd	(%rbx,%r11,2), %zmm29
	addq	$4096, %r11
	addq	$-8, %rcx
	vmulpd	%zmm29, %zmm29, %zmm29
	vaddpd	%zmm29, %zmm28, %zmm28
	vmulpd	%zmm28, %zmm30, %zmm28
	vaddpd	%zmm28, %zmm27, %zmm27
	jne	.LBB10_40
	cmpq	$0, -88(%rsp)
	je	.LBB10_47
	movq	-120(%rsp), %rcx
.LBB10_43:
	movq	%rcx, %r11
	shlq	$9, %r11
	shlq	$10, %rcx
	addq	-128(%rsp), %r11
	addq	-112(%rsp), %rcx
	xorl	%r12d, %r12d
	.p2align	4
.LBB10_44:
	vmovupd	(%rcx,%r12,2), %zmm28
	vmovupd	512(%rcx,%r12,2), %zmm29
	vmulpd	(%r11,%r12), %zmm0, %zmm30
	addq	$512, %r12
	vmulpd	%zmm28, %zmm28, %zmm28
	vmulpd	%zmm29, %zmm29, %zmm29
	vaddpd	%zmm29, %zmm28, %zmm28
	vmulpd	%zmm28, %zmm30, %zmm28
	vaddpd	%zmm28, %zmm27, %zmm27
	cmpq	%r12, %rbp
	jne	.LBB10_44
	vmulpd	%zmm25, %zmm19, %zmm25
	vmulpd	%zmm26, %zmm20, %zmm26
	cmpq	$4, 264(%rsp)
	vmovapd	%zmm27, %zmm24 {%k1}
	vmovupd	%zmm24, 512(%rdi)
	vaddpd	%zmm26, %zmm25, %zmm24
	jae	.LBB10_48
	xorl	%ecx, %ecx
	jmp	.LBB10_18
.LBB10_47:
	vmulpd	%zmm25, %zmm19, %zmm25
	vmulpd	%zmm26, %zmm20, %zmm26
	vmovapd	%zmm27, %zmm24 {%k1}
	vmovupd	%zmm24, 512(%rdi)
	vaddpd	%zmm26, %zmm25, %zmm24
.LBB10_48:
	cmpq	$0, -96(%rsp)
	je	.LBB10_49
	movq	24(%rsp), %rcx
	xorl	%r11d, %r11d
	.p2align	4
.LBB10_51:
	vmovupd	-7936(%r8,%r11,2), %zmm25
	vmovupd	-7424(%r8,%r11,2), %zmm26
	vmulpd	-3584(%rsi,%r11), %zmm0, %zmm28
	vmulpd	-3072(%rsi,%r11), %zmm0, %zmm27
	vmulpd	-7680(%r8,%r11,2), %zmm25, %zmm25
	vmulpd	-7168(%r8,%r11,2), %zmm26, %zmm26
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	-6912(%r8,%r11,2), %zmm26
	vmulpd	%zmm25, %zmm28, %zmm25
	vmulpd	-2560(%rsi,%r11), %zmm0, %zmm28
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	-6656(%r8,%r11,2), %zmm26, %zmm25
	vmovupd	-6400(%r8,%r11,2), %zmm26
	vmulpd	-6144(%r8,%r11,2), %zmm26, %zmm26
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	-5376(%r8,%r11,2), %zmm26
	vmulpd	-5120(%r8,%r11,2), %zmm26, %zmm26
	vmulpd	%zmm25, %zmm27, %zmm25
	vmovupd	-5888(%r8,%r11,2), %zmm27
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	-5632(%r8,%r11,2), %zmm27, %zmm25
	vmulpd	-2048(%rsi,%r11), %zmm0, %zmm27
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	-4864(%r8,%r11,2), %zmm26
	vmulpd	%zmm25, %zmm28, %zmm25
	vmulpd	-1536(%rsi,%r11), %zmm0, %zmm28
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	-4608(%r8,%r11,2), %zmm26, %zmm25
	vmovupd	-4352(%r8,%r11,2), %zmm26
	vmulpd	-4096(%r8,%r11,2), %zmm26, %zmm26
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	-3328(%r8,%r11,2), %zmm26
	vmulpd	-3072(%r8,%r11,2), %zmm26, %zmm26
	vmulpd	%zmm25, %zmm27, %zmm25
	vmovupd	-3840(%r8,%r11,2), %zmm27
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	-3584(%r8,%r11,2), %zmm27, %zmm25
	vmulpd	-1024(%rsi,%r11), %zmm0, %zmm27
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	-2816(%r8,%r11,2), %zmm26
	vmulpd	%zmm25, %zmm28, %zmm25
	vmulpd	-512(%rsi,%r11), %zmm0, %zmm28
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	-2560(%r8,%r11,2), %zmm26, %zmm25
	vmovupd	-2304(%r8,%r11,2), %zmm26
	vmulpd	-2048(%r8,%r11,2), %zmm26, %zmm26
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	-1280(%r8,%r11,2), %zmm26
	vmulpd	-1024(%r8,%r11,2), %zmm26, %zmm26
	vmulpd	%zmm25, %zmm27, %zmm25
	vmovupd	-1792(%r8,%r11,2), %zmm27
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	-1536(%r8,%r11,2), %zmm27, %zmm25
	vmulpd	(%rsi,%r11), %zmm0, %zmm27
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	-768(%r8,%r11,2), %zmm26
	vmulpd	%zmm25, %zmm28, %zmm25
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	-512(%r8,%r11,2), %zmm26, %zmm25
	vmovupd	-256(%r8,%r11,2), %zmm26
	vmulpd	(%r8,%r11,2), %zmm26, %zmm26
	addq	$4096, %r11
	addq	$-2, %rcx
	vaddpd	%zmm26, %zmm25, %zmm25
	vmulpd	%zmm25, %zmm27, %zmm25
	vaddpd	%zmm25, %zmm24, %zmm24
	jne	.LBB10_51
	movq	16(%rsp), %rcx
	testb	$4, -96(%rsp)
	je	.LBB10_16
	movq	56(%rsp), %rcx
	cmpq	$0, 64(%rsp)
	jne	.LBB10_18
	jmp	.LBB10_20
.LBB10_49:
	xorl	%ecx, %ecx
.LBB10_16:
	movq	-112(%rsp), %r11
	movq	-128(%rsp), %r12
	vmovupd	(%r11,%rcx,2), %zmm25
	vmovupd	512(%r11,%rcx,2), %zmm26
	vmulpd	(%r12,%rcx), %zmm0, %zmm28
	vmulpd	512(%r12,%rcx), %zmm0, %zmm27
	vmulpd	256(%r11,%rcx,2), %zmm25, %zmm25
	vmulpd	768(%r11,%rcx,2), %zmm26, %zmm26
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	1024(%r11,%rcx,2), %zmm26
	vmulpd	%zmm25, %zmm28, %zmm25
	vmulpd	1024(%r12,%rcx), %zmm0, %zmm28
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	1280(%r11,%rcx,2), %zmm26, %zmm25
	vmovupd	1536(%r11,%rcx,2), %zmm26
	vmulpd	1792(%r11,%rcx,2), %zmm26, %zmm26
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	2560(%r11,%rcx,2), %zmm26
	vmulpd	2816(%r11,%rcx,2), %zmm26, %zmm26
	vmulpd	%zmm25, %zmm27, %zmm25
	vmovupd	2048(%r11,%rcx,2), %zmm27
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	2304(%r11,%rcx,2), %zmm27, %zmm25
	vmulpd	1536(%r12,%rcx), %zmm0, %zmm27
	vaddpd	%zmm26, %zmm25, %zmm25
	vmovupd	3072(%r11,%rcx,2), %zmm26
	vmulpd	%zmm25, %zmm28, %zmm25
	vaddpd	%zmm25, %zmm24, %zmm24
	vmulpd	3328(%r11,%rcx,2), %zmm26, %zmm25
	vmovupd	3584(%r11,%rcx,2), %zmm26
	vmulpd	3840(%r11,%rcx,2), %zmm26, %zmm26
	vaddpd	%zmm26, %zmm25, %zmm25
	vmulpd	%zmm25, %zmm27, %zmm25
	vaddpd	%zmm25, %zmm24, %zmm24
	movq	56(%rsp), %rcx
	cmpq	$0, 64(%rsp)
	je	.LBB10_20
.LBB10_18:
	movq	%rcx, %r11
	shlq	$9, %r11
	shlq	$10, %rcx
	addq	-128(%rsp), %r11
	addq	-112(%rsp), %rcx
	xorl	%r12d, %r12d
	.p2align	4
.LBB10_19:
	vmovupd	(%rcx,%r12,2), %zmm25
	vmovupd	512(%rcx,%r12,2), %zmm26
	vmulpd	(%r11,%r12), %zmm0, %zmm27
	vmulpd	256(%rcx,%r12,2), %zmm25, %zmm25
	vmulpd	768(%rcx,%r12,2), %zmm26, %zmm26
	addq	$512, %r12
	vaddpd	%zmm26, %zmm25, %zmm25
	vmulpd	%zmm25, %zmm27, %zmm25
	vaddpd	%zmm25, %zmm24, %zmm24
	cmpq	%r12, %r15
	jne	.LBB10_19
.LBB10_20:
	vmulpd	%zmm22, %zmm19, %zmm19
	vmulpd	%zmm23, %zmm20, %zmm20
	cmpq	$8, 264(%rsp)
	vmovapd	%zmm24, %zmm21 {%k1}
	vmovupd	%zmm21, 768(%rdi)
	vmovupd	%zmm21, 1024(%rdi)
	vaddpd	%zmm20, %zmm19, %zmm19
	jae	.LBB10_22
	xorl	%ecx, %ecx
	jmp	.LBB10_25
.LBB10_22:
	movq	-120(%rsp), %rcx
	xorl	%r11d, %r11d
	.p2align	4
.LBB10_23:
	vmovupd	-7680(%r8,%r11,2), %zmm20
	vmovupd	-7168(%r8,%r11,2), %zmm21
	vmulpd	-3584(%rsi,%r11), %zmm0, %zmm23
	vmulpd	-3072(%rsi,%r11), %zmm0, %zmm22
	vmulpd	%zmm20, %zmm20, %zmm20
	vmulpd	%zmm21, %zmm21, %zmm21
	vaddpd	%zmm21, %zmm20, %zmm20
	vmovupd	-6656(%r8,%r11,2), %zmm21
	vmulpd	%zmm20, %zmm23, %zmm20
	vmulpd	-2560(%rsi,%r11), %zmm0, %zmm23
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm21, %zmm20
	vmovupd	-6144(%r8,%r11,2), %zmm21
	vmulpd	%zmm21, %zmm21, %zmm21
	vaddpd	%zmm21, %zmm20, %zmm20
	vmovupd	-5120(%r8,%r11,2), %zmm21
	vmulpd	%zmm20, %zmm22, %zmm20
	vmovupd	-5632(%r8,%r11,2), %zmm22
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm21, %zmm21
	vmulpd	%zmm22, %zmm22, %zmm20
	vmulpd	-2048(%rsi,%r11), %zmm0, %zmm22
	vaddpd	%zmm21, %zmm20, %zmm20
	vmovupd	-4608(%r8,%r11,2), %zmm21
	vmulpd	%zmm20, %zmm23, %zmm20
	vmulpd	-1536(%rsi,%r11), %zmm0, %zmm23
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm21, %zmm20
	vmovupd	-4096(%r8,%r11,2), %zmm21
	vmulpd	%zmm21, %zmm21, %zmm21
	vaddpd	%zmm21, %zmm20, %zmm20
	vmovupd	-3072(%r8,%r11,2), %zmm21
	vmulpd	%zmm20, %zmm22, %zmm20
	vmovupd	-3584(%r8,%r11,2), %zmm22
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm21, %zmm21
	vmulpd	%zmm22, %zmm22, %zmm20
	vmulpd	-1024(%rsi,%r11), %zmm0, %zmm22
	vaddpd	%zmm21, %zmm20, %zmm20
	vmovupd	-2560(%r8,%r11,2), %zmm21
	vmulpd	%zmm20, %zmm23, %zmm20
	vmulpd	-512(%rsi,%r11), %zmm0, %zmm23
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm21, %zmm20
	vmovupd	-2048(%r8,%r11,2), %zmm21
	vmulpd	%zmm21, %zmm21, %zmm21
	vaddpd	%zmm21, %zmm20, %zmm20
	vmovupd	-1024(%r8,%r11,2), %zmm21
	vmulpd	%zmm20, %zmm22, %zmm20
	vmovupd	-1536(%r8,%r11,2), %zmm22
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm21, %zmm21
	vmulpd	%zmm22, %zmm22, %zmm20
	vmulpd	(%rsi,%r11), %zmm0, %zmm22
	vaddpd	%zmm21, %zmm20, %zmm20
	vmovupd	-512(%r8,%r11,2), %zmm21
	vmulpd	%zmm20, %zmm23, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	vmulpd	%zmm21, %zmm21, %zmm20
	vmovupd	(%r8,%r11,2), %zmm21
	addq	$4096, %r11
	addq	$-8, %rcx
	vmulpd	%zmm21, %zmm21, %zmm21
	vaddpd	%zmm21, %zmm20, %zmm20
	vmulpd	%zmm20, %zmm22, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	jne	.LBB10_23
	movq	-120(%rsp), %rcx
	cmpq	$0, -88(%rsp)
	je	.LBB10_27
.LBB10_25:
	movq	%rcx, %r11
	shlq	$9, %r11
	shlq	$10, %rcx
	addq	-128(%rsp), %r11
	addq	-80(%rsp), %rcx
	xorl	%r12d, %r12d
	.p2align	4
.LBB10_26:
	vmovupd	(%rcx,%r12,2), %zmm20
	vmovupd	512(%rcx,%r12,2), %zmm21
	vmulpd	(%r11,%r12), %zmm0, %zmm22
	addq	$512, %r12
	vmulpd	%zmm20, %zmm20, %zmm20
	vmulpd	%zmm21, %zmm21, %zmm21
	vaddpd	%zmm21, %zmm20, %zmm20
	vmulpd	%zmm20, %zmm22, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	cmpq	%r12, %rbp
	jne	.LBB10_26
.LBB10_27:
	cmpq	$0, 272(%rsp)
	movq	-72(%rsp), %r11
	vmovapd	%zmm19, %zmm18 {%k1}
	vmovupd	%zmm18, 1280(%rdi)
	jle	.LBB10_36
	cmpq	$1, 272(%rsp)
	je	.LBB10_35
	cmpq	$0, -104(%rsp)
	movq	%r11, %r12
	je	.LBB10_33
	movq	-56(%rsp), %rcx
	leaq	(%r10,%r10,2), %r9
	movq	%r11, %r12
	.p2align	4
.LBB10_31:
	vmovupd	10240(%rdi), %zmm18
	vmovupd	10496(%rdi), %zmm19
	vmovupd	10752(%rdi), %zmm20
	leaq	(%r12,%rdx), %r11
	addq	$-2, %rcx
	vmulpd	256(%r12), %zmm18, %zmm18
	vmulpd	512(%r12), %zmm19, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm18, 7680(%rdi)
	vmovupd	11008(%rdi), %zmm22
	vmulpd	256(%r12), %zmm20, %zmm19
	vmulpd	512(%r12), %zmm22, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	vmovupd	%zmm19, 7936(%rdi)
	vmovupd	%zmm18, 256(%r12) {%k1}
	vmovupd	7936(%rdi), %zmm18
	vmovupd	%zmm18, 512(%r12) {%k1}
	vmovupd	10240(%rdi), %zmm18
	vmovupd	10496(%rdi), %zmm19
	vmovupd	10752(%rdi), %zmm20
	vmulpd	1024(%r12,%r10), %zmm18, %zmm18
	vmulpd	1280(%r12,%r10), %zmm19, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm18, 7680(%rdi)
	vmovupd	11008(%rdi), %zmm21
	vmulpd	1024(%r12,%r10), %zmm20, %zmm19
	vmulpd	1280(%r12,%r10), %zmm21, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	vmovupd	%zmm19, 7936(%rdi)
	vmovupd	%zmm18, 1024(%r12,%r10) {%k1}
	vmovupd	7936(%rdi), %zmm18
	vmovupd	%zmm18, 1280(%r12,%r10) {%k1}
	vmovupd	10240(%rdi), %zmm18
	vmovupd	10496(%rdi), %zmm19
	vmovupd	10752(%rdi), %zmm20
	vmulpd	1792(%r12,%rdx), %zmm18, %zmm18
	vmulpd	2048(%r12,%rdx), %zmm19, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm18, 7680(%rdi)
	vmovupd	11008(%rdi), %zmm22
	vmulpd	1792(%r12,%rdx), %zmm20, %zmm19
	vmulpd	2048(%r12,%rdx), %zmm22, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	vmovupd	%zmm19, 7936(%rdi)
	vmovupd	%zmm18, 1792(%r12,%rdx) {%k1}
	vmovupd	7936(%rdi), %zmm18
	vmovupd	%zmm18, 2048(%r12,%rdx) {%k1}
	vmovupd	10240(%rdi), %zmm18
	vmovupd	10496(%rdi), %zmm19
	vmovupd	10752(%rdi), %zmm20
	vmulpd	2560(%r12,%r9), %zmm18, %zmm18
	vmulpd	2816(%r12,%r9), %zmm19, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm18, 7680(%rdi)
	vmovupd	11008(%rdi), %zmm21
	vmulpd	2560(%r12,%r9), %zmm20, %zmm19
	vmulpd	2816(%r12,%r9), %zmm21, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	vmovupd	%zmm19, 7936(%rdi)
	vmovupd	%zmm18, 2560(%r12,%r9) {%k1}
	vmovupd	7936(%rdi), %zmm18
	vmovupd	%zmm18, 2816(%r12,%r9) {%k1}
	leaq	3072(%rdx,%r11), %r12
	jne	.LBB10_31
	testb	$2, -104(%rsp)
	movq	-72(%rsp), %r11
	jne	.LBB10_34
.LBB10_33:
	vmovupd	10240(%rdi), %zmm18
	vmovupd	10496(%rdi), %zmm19
	vmovupd	10752(%rdi), %zmm20
	vmulpd	256(%r12), %zmm18, %zmm18
	vmulpd	512(%r12), %zmm19, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm18, 7680(%rdi)
	vmovupd	11008(%rdi), %zmm22
	vmulpd	256(%r12), %zmm20, %zmm19
	vmulpd	512(%r12), %zmm22, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	vmovupd	%zmm19, 7936(%rdi)
	vmovupd	%zmm18, 256(%r12) {%k1}
	vmovupd	7936(%rdi), %zmm18
	vmovupd	%zmm18, 512(%r12) {%k1}
	vmovupd	10240(%rdi), %zmm18
	vmovupd	10496(%rdi), %zmm19
	vmovupd	10752(%rdi), %zmm20
	vmulpd	1024(%r12,%r10), %zmm18, %zmm18
	vmulpd	1280(%r12,%r10), %zmm19, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm18, 7680(%rdi)
	vmovupd	11008(%rdi), %zmm21
	vmulpd	1024(%r12,%r10), %zmm20, %zmm19
	vmulpd	1280(%r12,%r10), %zmm21, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	vmovupd	%zmm19, 7936(%rdi)
	vmovupd	%zmm18, 1024(%r12,%r10) {%k1}
	vmovupd	7936(%rdi), %zmm18
	vmovupd	%zmm18, 1280(%r12,%r10) {%k1}
.LBB10_34:
	movq	272(%rsp), %rcx
	testb	$1, %cl
	je	.LBB10_36
.LBB10_35:
	movq	72(%rsp), %rcx
	vmovupd	10240(%rdi), %zmm18
	vmovupd	10496(%rdi), %zmm19
	vmovupd	10752(%rdi), %zmm20
	vmulpd	256(%rcx,%rax,8), %zmm18, %zmm18
	vmulpd	512(%rcx,%rax,8), %zmm19, %zmm19
	vaddpd	%zmm19, %zmm18, %zmm18
	vmovupd	%zmm18, 7680(%rdi)
	vmovupd	11008(%rdi), %zmm21
	vmulpd	256(%rcx,%rax,8), %zmm20, %zmm19
	vmulpd	512(%rcx,%rax,8), %zmm21, %zmm20
	vaddpd	%zmm20, %zmm19, %zmm19
	vmovupd	%zmm19, 7936(%rdi)
	vmovupd	%zmm18, 256(%rcx,%rax,8) {%k1}
	vmovupd	7936(%rdi), %zmm18
	vmovupd	%zmm18, 512(%rcx,%rax,8) {%k1}
.LBB10_36:
	cmpb	$0, 296(%rsp)
	movq	264(%rsp), %r12
	je	.LBB10_37
	vmovupd	11264(%rdi), %zmm18
	vmovupd	10240(%rdi), %zmm19
	vmovupd	10496(%rdi), %zmm20
	vmovupd	11776(%rdi), %zmm23
	vmovupd	10752(%rdi), %zmm21
	vmovupd	11008(%rdi), %zmm25
	vmulpd	%zmm18, %zmm19, %zmm22
	vmulpd	%zmm23, %zmm20, %zmm24
	vmulpd	%zmm21, %zmm18, %zmm18
	vmulpd	%zmm25, %zmm23, %zmm23
	vaddpd	%zmm24, %zmm22, %zmm22
	vaddpd	%zmm23, %zmm18, %zmm18
	vmovupd	%zmm22, 11264(%rdi)
	vmovupd	%zmm18, 11776(%rdi)
	vmovupd	11520(%rdi), %zmm18
	vmovupd	12032(%rdi), %zmm22
	vmulpd	%zmm18, %zmm19, %zmm19
	vmulpd	%zmm22, %zmm20, %zmm20
	vmulpd	%zmm18, %zmm21, %zmm18
	vmulpd	%zmm22, %zmm25, %zmm21
	vaddpd	%zmm20, %zmm19, %zmm19
	vaddpd	%zmm21, %zmm18, %zmm18
	vmovupd	%zmm19, 7680(%rdi)
	vmovupd	%zmm18, 7936(%rdi)
	vmovupd	%zmm19, 11520(%rdi)
	vmovupd	%zmm18, 12032(%rdi)
	jmp	.LBB10_37
.Lfunc_end10:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7carriedB3v55B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxdxxbx, .Lfunc_end10-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7carriedB3v55B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxdxxbx

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI11_0:
	.quad	0x3fe0000000000000
.LCPI11_1:
	.quad	0x7fffffffffffffff
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v38B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2824_2924Literal_5bint_5d_2838_29x
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v38B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2824_2924Literal_5bint_5d_2838_29x,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v38B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2824_2924Literal_5bint_5d_2838_29x:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$56, %rsp
	.cfi_def_cfa_offset 112
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	304(%rsp), %r8
	movq	%rdx, %r9
	movq	192(%rsp), %r14
	movq	120(%rsp), %r15
	movq	%rdi, %rbx
	movq	$0, 32(%rsp)
	movq	$0, 24(%rsp)
	leaq	7(%r8), %rdx
	movq	%rdx, %r13
	shrq	$3, %r13
	testq	%r8, %r8
	setle	%al
	testq	%r13, %r13
	sete	%cl
	orb	%al, %cl
	je	.LBB11_1
	leaq	8(%rsp), %rdi
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r14, %rcx
	movq	%r8, %r13
	movq	%r9, %r12
	callq	*%r9
	leaq	32(%rsp), %rdi
	leaq	24(%rsp), %rsi
	movl	%eax, %ebp
	movq	%r15, %rdx
	movq	%r14, %rcx
	movq	%r13, %r8
	callq	*%r12
	jmp	.LBB11_33
.LBB11_1:
	movq	%rbx, 48(%rsp)
	movq	248(%rsp), %rbx
	movl	%r13d, %r12d
	andl	$7, %r12d
	movq	%rdx, 40(%rsp)
	cmpq	$64, %rdx
	jae	.LBB11_3
	xorl	%ecx, %ecx
	jmp	.LBB11_6
.LBB11_3:
	movq	%rdx, %rax
	shrq	$6, %rax
	xorl	%ecx, %ecx
	shlq	$3, %rax
	.p2align	4
.LBB11_4:
	vmovupd	6144(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6656(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, (%rdx,%rcx,8)
	vmovups	7680(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%rcx,8)
	vmovupd	6208(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6720(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 64(%rdx,%rcx,8)
	vmovups	7744(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%rcx,8)
	vmovupd	6272(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6784(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 128(%rdx,%rcx,8)
	vmovups	7808(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%rcx,8)
	vmovupd	6336(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6848(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 192(%rdx,%rcx,8)
	vmovups	7872(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8384(%rbx,%rcx,8)
	vmovupd	6400(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6912(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 256(%rdx,%rcx,8)
	vmovups	7936(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8448(%rbx,%rcx,8)
	vmovupd	6464(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	6976(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 320(%rdx,%rcx,8)
	vmovups	8000(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8512(%rbx,%rcx,8)
	vmovupd	6528(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	7040(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 384(%rdx,%rcx,8)
	vmovups	8064(%rbx,%rcx,8), %zmm0
	vmovups	%zmm0, 8576(%rbx,%rcx,8)
	vmovupd	6592(%rbx,%rcx,8), %zmm0
	movq	8(%r14), %rdx
	vaddpd	7104(%rbx,%rcx,8), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	addq	$-8, %rax
	vmovupd	%zmm0, 448(%rdx,%rcx,8)
	vmovupd	8128(%rbx,%rcx,8), %zmm0
	vmovupd	%zmm0, 8640(%rbx,%rcx,8)
	leaq	64(%rcx), %rcx
	jne	.LBB11_4
	testq	%r12, %r12
	je	.LBB11_8
.LBB11_6:
	leaq	8192(%rbx,%rcx,8), %rax
	leaq	(%r15,%rcx,8), %rcx
	movl	%r12d, %edx
	shll	$6, %edx
	xorl	%esi, %esi
	.p2align	4
.LBB11_7:
	vmovupd	-2048(%rax,%rsi), %zmm0
	movq	8(%r14), %rdi
	vaddpd	-1536(%rax,%rsi), %zmm0, %zmm0
	shlq	$8, %rdi
	addq	%rcx, %rdi
	vmovupd	%zmm0, (%rsi,%rdi)
	vmovupd	-512(%rax,%rsi), %zmm0
	vmovupd	%zmm0, (%rax,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rdx
	jne	.LBB11_7
.LBB11_8:
	leaq	7680(%rbx), %rbp
	leaq	4(%r13), %rax
	xorl	%ecx, %ecx
	.p2align	4
.LBB11_9:
	vmovupd	6400(%rbx,%rcx), %zmm0
	movq	8(%r14), %rdx
	decq	%rax
	vaddpd	6912(%rbx,%rcx), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 256(%rcx,%rdx)
	vmovupd	7936(%rbx,%rcx), %zmm0
	vmovupd	%zmm0, 8448(%rbx,%rcx)
	addq	$64, %rcx
	cmpq	$4, %rax
	ja	.LBB11_9
	leaq	8(%rsp), %rdi
	movq	%r14, %rcx
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r9, %r14
	vzeroupper
	callq	*%r9
	cmpq	$64, 40(%rsp)
	movl	%eax, 20(%rsp)
	jae	.LBB11_12
	movq	192(%rsp), %rcx
	movq	304(%rsp), %r8
	xorl	%edx, %edx
	movq	%r14, %r9
	jmp	.LBB11_19
.LBB11_12:
	movq	304(%rsp), %r8
	leaq	-8(%r13), %rax
	movq	%r14, %r9
	movq	%rax, %rdi
	shrq	$3, %rdi
	je	.LBB11_13
	movq	192(%rsp), %rcx
	incq	%rdi
	xorl	%edx, %edx
	andq	$-2, %rdi
	.p2align	4
.LBB11_15:
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7680(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	64(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7744(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	128(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7808(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	192(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7872(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	256(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 7936(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	320(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	384(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	448(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8128(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	512(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8192(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	576(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8256(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	640(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8320(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	704(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8384(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	768(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8448(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	832(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8512(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovups	896(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8576(%rbx,%rdx,8)
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	addq	$-2, %rdi
	vmovupd	960(%rsi,%rdx,8), %zmm0
	vmovupd	%zmm0, 8640(%rbx,%rdx,8)
	leaq	128(%rdx), %rdx
	jne	.LBB11_15
	testb	$8, %al
	je	.LBB11_17
	testq	%r12, %r12
	jne	.LBB11_19
	jmp	.LBB11_21
.LBB11_13:
	movq	192(%rsp), %rcx
	xorl	%edx, %edx
.LBB11_17:
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7680(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	64(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7744(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	128(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7808(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	192(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7872(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	256(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 7936(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	320(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 8000(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovups	384(%rax,%rdx,8), %zmm0
	vmovups	%zmm0, 8064(%rbx,%rdx,8)
	movq	16(%rcx), %rax
	shlq	$8, %rax
	addq	%r15, %rax
	vmovupd	448(%rax,%rdx,8), %zmm0
	vmovupd	%zmm0, 8128(%rbx,%rdx,8)
	addq	$64, %rdx
	testq	%r12, %r12
	je	.LBB11_21
.LBB11_19:
	leaq	7680(%rbx,%rdx,8), %rax
	leaq	(%r15,%rdx,8), %rdi
	shll	$6, %r12d
	xorl	%edx, %edx
	.p2align	4
.LBB11_20:
	movq	16(%rcx), %rsi
	shlq	$8, %rsi
	addq	%rdi, %rsi
	vmovupd	(%rdx,%rsi), %zmm0
	vmovupd	%zmm0, (%rax,%rdx)
	addq	$64, %rdx
	cmpq	%rdx, %r12
	jne	.LBB11_20
.LBB11_21:
	leaq	4(%r13), %r14
	leaq	7936(%rbx), %r12
	addq	$5, %r13
	xorl	%eax, %eax
	.p2align	4
.LBB11_22:
	movq	16(%rcx), %rdx
	decq	%r13
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	256(%rax,%rdx), %zmm0
	vmovupd	%zmm0, (%r12,%rax)
	addq	$64, %rax
	cmpq	$5, %r13
	ja	.LBB11_22
	xorl	%eax, %eax
	movq	%r14, %rsi
	.p2align	4
.LBB11_24:
	vmovupd	6144(%rbx,%rax), %zmm0
	movq	8(%rcx), %rdx
	decq	%rsi
	vsubpd	6656(%rbx,%rax), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, (%rax,%rdx)
	addq	$64, %rax
	cmpq	$4, %rsi
	ja	.LBB11_24
	xorl	%eax, %eax
	movq	%r14, %rsi
	.p2align	4
.LBB11_26:
	vmovupd	6400(%rbx,%rax), %zmm0
	movq	8(%rcx), %rdx
	decq	%rsi
	vsubpd	6912(%rbx,%rax), %zmm0, %zmm0
	shlq	$8, %rdx
	addq	%r15, %rdx
	vmovupd	%zmm0, 256(%rax,%rdx)
	addq	$64, %rax
	cmpq	$4, %rsi
	ja	.LBB11_26
	leaq	32(%rsp), %rdi
	leaq	24(%rsp), %rsi
	movq	%r15, %rdx
	vzeroupper
	callq	*%r9
	movabsq	$.LCPI11_0, %rcx
	movq	192(%rsp), %rdi
	movq	%r15, %rdx
	vbroadcastsd	(%rcx), %zmm0
	movabsq	$.LCPI11_1, %rcx
	vbroadcastsd	(%rcx), %zmm1
	movq	%r14, %rcx
	.p2align	4
.LBB11_28:
	movq	16(%rdi), %rsi
	vmovupd	(%rbp), %zmm2
	decq	%rcx
	shlq	$8, %rsi
	vaddpd	(%rdx,%rsi), %zmm2, %zmm2
	addq	$64, %rdx
	vmulpd	%zmm0, %zmm2, %zmm2
	vsubpd	512(%rbp), %zmm2, %zmm2
	vandpd	%zmm1, %zmm2, %zmm2
	vmovupd	%zmm2, 2048(%rbp)
	addq	$64, %rbp
	cmpq	$4, %rcx
	ja	.LBB11_28
	movq	48(%rsp), %rbx
	addq	$256, %r15
	.p2align	4
.LBB11_30:
	movq	16(%rdi), %rcx
	vmovupd	(%r12), %zmm2
	decq	%r14
	shlq	$8, %rcx
	vaddpd	(%r15,%rcx), %zmm2, %zmm2
	addq	$64, %r15
	vmulpd	%zmm0, %zmm2, %zmm2
	vsubpd	512(%r12), %zmm2, %zmm2
	vandpd	%zmm1, %zmm2, %zmm2
	vmovupd	%zmm2, 2048(%r12)
	addq	$64, %r12
	cmpq	$4, %r14
	ja	.LBB11_30
	movl	20(%rsp), %ebp
.LBB11_33:
	orl	%eax, %ebp
	movslq	%ebp, %rax
	movq	%rax, (%rbx)
	xorl	%eax, %eax
	addq	$56, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.Lfunc_end11:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v38B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2824_2924Literal_5bint_5d_2838_29x, .Lfunc_end11-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v38B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2824_2924Literal_5bint_5d_2838_29x
	.cfi_endproc

	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v32B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29d24Literal_5bint_5d_2822_2924Literal_5bint_5d_2816_29x
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v32B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29d24Literal_5bint_5d_2822_2924Literal_5bint_5d_2816_29x,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v32B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29d24Literal_5bint_5d_2822_2924Literal_5bint_5d_2816_29x:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$24, %rsp
	.cfi_def_cfa_offset 80
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	280(%rsp), %r8
	movq	160(%rsp), %r14
	movq	88(%rsp), %r15
	movq	%rdx, %rax
	movq	%rdi, %r13
	leaq	7(%r8), %rbx
	movq	%rbx, %r12
	shrq	$3, %r12
	testq	%r8, %r8
	setg	%cl
	testq	%r12, %r12
	setne	%dl
	testb	%dl, %cl
	jne	.LBB12_2
	leaq	8(%rsp), %rdi
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r14, %rcx
	callq	*%rax
	jmp	.LBB12_25
.LBB12_2:
	movq	%r13, 16(%rsp)
	movq	216(%rsp), %r13
	vbroadcastsd	%xmm0, %zmm0
	movl	%r12d, %ebp
	andl	$7, %ebp
	cmpq	$64, %rbx
	jae	.LBB12_4
	xorl	%edx, %edx
	jmp	.LBB12_7
.LBB12_4:
	movq	%rbx, %rcx
	shrq	$6, %rcx
	xorl	%edx, %edx
	shlq	$3, %rcx
	.p2align	4
.LBB12_5:
	vmulpd	3584(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 5632(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, (%rsi,%rdx,8)
	vmulpd	3648(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	64(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 5696(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 64(%rsi,%rdx,8)
	vmulpd	3712(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	128(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 5760(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 128(%rsi,%rdx,8)
	vmulpd	3776(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	192(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 5824(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 192(%rsi,%rdx,8)
	vmulpd	3840(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	256(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 5888(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 256(%rsi,%rdx,8)
	vmulpd	3904(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	320(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 5952(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 320(%rsi,%rdx,8)
	vmulpd	3968(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	384(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6016(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 384(%rsi,%rdx,8)
	vmulpd	4032(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	448(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6080(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	addq	$-8, %rcx
	vmovupd	%zmm1, 448(%rsi,%rdx,8)
	leaq	64(%rdx), %rdx
	jne	.LBB12_5
	testq	%rbp, %rbp
	je	.LBB12_9
.LBB12_7:
	leaq	(%r15,%rdx,8), %rcx
	leaq	5632(%r13,%rdx,8), %rdx
	movl	%ebp, %esi
	shll	$6, %esi
	xorl	%edi, %edi
	.p2align	4
.LBB12_8:
	vmulpd	-2048(%rdx,%rdi), %zmm0, %zmm1
	vaddpd	-5632(%rdx,%rdi), %zmm1, %zmm1
	vmovupd	%zmm1, (%rdx,%rdi)
	movq	8(%r14), %r9
	shlq	$8, %r9
	addq	%rcx, %r9
	vmovupd	%zmm1, (%rdi,%r9)
	addq	$64, %rdi
	cmpq	%rdi, %rsi
	jne	.LBB12_8
.LBB12_9:
	leaq	4(%r12), %rcx
	movl	$256, %edx
	.p2align	4
.LBB12_10:
	vmulpd	3584(%r13,%rdx), %zmm0, %zmm1
	decq	%rcx
	vaddpd	(%r13,%rdx), %zmm1, %zmm1
	vmovupd	%zmm1, 5632(%r13,%rdx)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, (%rdx,%rsi)
	addq	$64, %rdx
	cmpq	$4, %rcx
	ja	.LBB12_10
	leaq	8(%rsp), %rdi
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r14, %rcx
	vzeroupper
	callq	*%rax
	cmpq	$64, %rbx
	jae	.LBB12_13
	xorl	%esi, %esi
	jmp	.LBB12_20
.LBB12_13:
	leaq	-8(%r12), %rcx
	movq	%rcx, %rdx
	shrq	$3, %rdx
	je	.LBB12_14
	incq	%rdx
	xorl	%esi, %esi
	andq	$-2, %rdx
	.p2align	4
.LBB12_16:
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4096(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	64(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4160(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	128(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4224(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	192(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4288(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	256(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4352(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	320(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4416(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	384(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4480(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	448(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4544(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	512(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4608(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	576(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4672(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	640(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4736(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	704(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4800(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	768(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4864(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	832(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4928(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	896(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4992(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	addq	$-2, %rdx
	vmovupd	960(%rdi,%rsi,8), %zmm0
	vmovupd	%zmm0, 5056(%r13,%rsi,8)
	leaq	128(%rsi), %rsi
	jne	.LBB12_16
	testb	$8, %cl
	je	.LBB12_18
	testq	%rbp, %rbp
	jne	.LBB12_20
	jmp	.LBB12_22
.LBB12_14:
	xorl	%esi, %esi
.LBB12_18:
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4096(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	64(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4160(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	128(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4224(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	192(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4288(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	256(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4352(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	320(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4416(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	384(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4480(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovupd	448(%rcx,%rsi,8), %zmm0
	vmovupd	%zmm0, 4544(%r13,%rsi,8)
	addq	$64, %rsi
	testq	%rbp, %rbp
	je	.LBB12_22
.LBB12_20:
	leaq	4096(%r13,%rsi,8), %rcx
	leaq	(%r15,%rsi,8), %rdx
	shll	$6, %ebp
	xorl	%esi, %esi
	.p2align	4
.LBB12_21:
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%rdx, %rdi
	vmovupd	(%rsi,%rdi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rbp
	jne	.LBB12_21
.LBB12_22:
	addq	$4352, %r13
	addq	$256, %r15
	addq	$5, %r12
	.p2align	4
.LBB12_23:
	movq	16(%r14), %rcx
	decq	%r12
	shlq	$8, %rcx
	vmovupd	(%r15,%rcx), %zmm0
	addq	$64, %r15
	vmovupd	%zmm0, (%r13)
	addq	$64, %r13
	cmpq	$5, %r12
	ja	.LBB12_23
	movq	16(%rsp), %r13
.LBB12_25:
	movl	%eax, (%r13)
	xorl	%eax, %eax
	addq	$24, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.Lfunc_end12:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v32B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29d24Literal_5bint_5d_2822_2924Literal_5bint_5d_2816_29x, .Lfunc_end12-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v32B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29d24Literal_5bint_5d_2822_2924Literal_5bint_5d_2816_29x
	.cfi_endproc

	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v34B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2818_29x
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v34B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2818_29x,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v34B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2818_29x:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$24, %rsp
	.cfi_def_cfa_offset 80
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	280(%rsp), %r8
	movq	160(%rsp), %r14
	movq	88(%rsp), %r15
	movq	%rdx, %rax
	movq	%rdi, %r13
	leaq	7(%r8), %rbx
	movq	%rbx, %r12
	shrq	$3, %r12
	testq	%r8, %r8
	setg	%cl
	testq	%r12, %r12
	setne	%dl
	testb	%dl, %cl
	jne	.LBB13_2
	leaq	8(%rsp), %rdi
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r14, %rcx
	callq	*%rax
	jmp	.LBB13_25
.LBB13_2:
	movq	%r13, 16(%rsp)
	movq	216(%rsp), %r13
	vbroadcastsd	%xmm0, %zmm0
	movl	%r12d, %ebp
	andl	$7, %ebp
	cmpq	$64, %rbx
	jae	.LBB13_4
	xorl	%edx, %edx
	jmp	.LBB13_7
.LBB13_4:
	movq	%rbx, %rcx
	shrq	$6, %rcx
	xorl	%edx, %edx
	shlq	$3, %rcx
	.p2align	4
.LBB13_5:
	vmulpd	4096(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6144(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, (%rsi,%rdx,8)
	vmulpd	4160(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	64(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6208(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 64(%rsi,%rdx,8)
	vmulpd	4224(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	128(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6272(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 128(%rsi,%rdx,8)
	vmulpd	4288(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	192(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6336(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 192(%rsi,%rdx,8)
	vmulpd	4352(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	256(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6400(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 256(%rsi,%rdx,8)
	vmulpd	4416(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	320(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6464(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 320(%rsi,%rdx,8)
	vmulpd	4480(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	384(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6528(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 384(%rsi,%rdx,8)
	vmulpd	4544(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	448(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6592(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	addq	$-8, %rcx
	vmovupd	%zmm1, 448(%rsi,%rdx,8)
	leaq	64(%rdx), %rdx
	jne	.LBB13_5
	testq	%rbp, %rbp
	je	.LBB13_9
.LBB13_7:
	leaq	(%r15,%rdx,8), %rcx
	leaq	6144(%r13,%rdx,8), %rdx
	movl	%ebp, %esi
	shll	$6, %esi
	xorl	%edi, %edi
	.p2align	4
.LBB13_8:
	vmulpd	-2048(%rdx,%rdi), %zmm0, %zmm1
	vaddpd	-6144(%rdx,%rdi), %zmm1, %zmm1
	vmovupd	%zmm1, (%rdx,%rdi)
	movq	8(%r14), %r9
	shlq	$8, %r9
	addq	%rcx, %r9
	vmovupd	%zmm1, (%rdi,%r9)
	addq	$64, %rdi
	cmpq	%rdi, %rsi
	jne	.LBB13_8
.LBB13_9:
	leaq	4(%r12), %rcx
	movl	$256, %edx
	.p2align	4
.LBB13_10:
	vmulpd	4096(%r13,%rdx), %zmm0, %zmm1
	decq	%rcx
	vaddpd	(%r13,%rdx), %zmm1, %zmm1
	vmovupd	%zmm1, 6144(%r13,%rdx)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, (%rdx,%rsi)
	addq	$64, %rdx
	cmpq	$4, %rcx
	ja	.LBB13_10
	leaq	8(%rsp), %rdi
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r14, %rcx
	vzeroupper
	callq	*%rax
	cmpq	$64, %rbx
	jae	.LBB13_13
	xorl	%esi, %esi
	jmp	.LBB13_20
.LBB13_13:
	leaq	-8(%r12), %rcx
	movq	%rcx, %rdx
	shrq	$3, %rdx
	je	.LBB13_14
	incq	%rdx
	xorl	%esi, %esi
	andq	$-2, %rdx
	.p2align	4
.LBB13_16:
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4608(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	64(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4672(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	128(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4736(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	192(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4800(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	256(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4864(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	320(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4928(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	384(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 4992(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	448(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5056(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	512(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5120(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	576(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5184(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	640(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5248(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	704(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5312(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	768(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5376(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	832(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5440(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	896(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5504(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	addq	$-2, %rdx
	vmovupd	960(%rdi,%rsi,8), %zmm0
	vmovupd	%zmm0, 5568(%r13,%rsi,8)
	leaq	128(%rsi), %rsi
	jne	.LBB13_16
	testb	$8, %cl
	je	.LBB13_18
	testq	%rbp, %rbp
	jne	.LBB13_20
	jmp	.LBB13_22
.LBB13_14:
	xorl	%esi, %esi
.LBB13_18:
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4608(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	64(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4672(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	128(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4736(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	192(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4800(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	256(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4864(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	320(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4928(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	384(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 4992(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovupd	448(%rcx,%rsi,8), %zmm0
	vmovupd	%zmm0, 5056(%r13,%rsi,8)
	addq	$64, %rsi
	testq	%rbp, %rbp
	je	.LBB13_22
.LBB13_20:
	leaq	4608(%r13,%rsi,8), %rcx
	leaq	(%r15,%rsi,8), %rdx
	shll	$6, %ebp
	xorl	%esi, %esi
	.p2align	4
.LBB13_21:
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%rdx, %rdi
	vmovupd	(%rsi,%rdi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rbp
	jne	.LBB13_21
.LBB13_22:
	addq	$4864, %r13
	addq	$256, %r15
	addq	$5, %r12
	.p2align	4
.LBB13_23:
	movq	16(%r14), %rcx
	decq	%r12
	shlq	$8, %rcx
	vmovupd	(%r15,%rcx), %zmm0
	addq	$64, %r15
	vmovupd	%zmm0, (%r13)
	addq	$64, %r13
	cmpq	$5, %r12
	ja	.LBB13_23
	movq	16(%rsp), %r13
.LBB13_25:
	movl	%eax, (%r13)
	xorl	%eax, %eax
	addq	$24, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.Lfunc_end13:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v34B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2818_29x, .Lfunc_end13-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v34B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2818_29x
	.cfi_endproc

	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v36B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2820_29x
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v36B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2820_29x,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v36B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2820_29x:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$24, %rsp
	.cfi_def_cfa_offset 80
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	280(%rsp), %r8
	movq	160(%rsp), %r14
	movq	88(%rsp), %r15
	movq	%rdx, %rax
	movq	%rdi, %r13
	leaq	7(%r8), %rbx
	movq	%rbx, %r12
	shrq	$3, %r12
	testq	%r8, %r8
	setg	%cl
	testq	%r12, %r12
	setne	%dl
	testb	%dl, %cl
	jne	.LBB14_2
	leaq	8(%rsp), %rdi
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r14, %rcx
	callq	*%rax
	jmp	.LBB14_25
.LBB14_2:
	movq	%r13, 16(%rsp)
	movq	216(%rsp), %r13
	vbroadcastsd	%xmm0, %zmm0
	movl	%r12d, %ebp
	andl	$7, %ebp
	cmpq	$64, %rbx
	jae	.LBB14_4
	xorl	%edx, %edx
	jmp	.LBB14_7
.LBB14_4:
	movq	%rbx, %rcx
	shrq	$6, %rcx
	xorl	%edx, %edx
	shlq	$3, %rcx
	.p2align	4
.LBB14_5:
	vmulpd	4608(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6144(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, (%rsi,%rdx,8)
	vmulpd	4672(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	64(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6208(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 64(%rsi,%rdx,8)
	vmulpd	4736(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	128(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6272(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 128(%rsi,%rdx,8)
	vmulpd	4800(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	192(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6336(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 192(%rsi,%rdx,8)
	vmulpd	4864(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	256(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6400(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 256(%rsi,%rdx,8)
	vmulpd	4928(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	320(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6464(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 320(%rsi,%rdx,8)
	vmulpd	4992(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	384(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6528(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, 384(%rsi,%rdx,8)
	vmulpd	5056(%r13,%rdx,8), %zmm0, %zmm1
	vaddpd	448(%r13,%rdx,8), %zmm1, %zmm1
	vmovupd	%zmm1, 6592(%r13,%rdx,8)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	addq	$-8, %rcx
	vmovupd	%zmm1, 448(%rsi,%rdx,8)
	leaq	64(%rdx), %rdx
	jne	.LBB14_5
	testq	%rbp, %rbp
	je	.LBB14_9
.LBB14_7:
	leaq	(%r15,%rdx,8), %rcx
	leaq	6144(%r13,%rdx,8), %rdx
	movl	%ebp, %esi
	shll	$6, %esi
	xorl	%edi, %edi
	.p2align	4
.LBB14_8:
	vmulpd	-1536(%rdx,%rdi), %zmm0, %zmm1
	vaddpd	-6144(%rdx,%rdi), %zmm1, %zmm1
	vmovupd	%zmm1, (%rdx,%rdi)
	movq	8(%r14), %r9
	shlq	$8, %r9
	addq	%rcx, %r9
	vmovupd	%zmm1, (%rdi,%r9)
	addq	$64, %rdi
	cmpq	%rdi, %rsi
	jne	.LBB14_8
.LBB14_9:
	leaq	4(%r12), %rcx
	movl	$256, %edx
	.p2align	4
.LBB14_10:
	vmulpd	4608(%r13,%rdx), %zmm0, %zmm1
	decq	%rcx
	vaddpd	(%r13,%rdx), %zmm1, %zmm1
	vmovupd	%zmm1, 6144(%r13,%rdx)
	movq	8(%r14), %rsi
	shlq	$8, %rsi
	addq	%r15, %rsi
	vmovupd	%zmm1, (%rdx,%rsi)
	addq	$64, %rdx
	cmpq	$4, %rcx
	ja	.LBB14_10
	leaq	8(%rsp), %rdi
	movq	$0, 8(%rsp)
	movq	$0, (%rsp)
	movq	%rsp, %rsi
	movq	%r15, %rdx
	movq	%r14, %rcx
	vzeroupper
	callq	*%rax
	cmpq	$64, %rbx
	jae	.LBB14_13
	xorl	%esi, %esi
	jmp	.LBB14_20
.LBB14_13:
	leaq	-8(%r12), %rcx
	movq	%rcx, %rdx
	shrq	$3, %rdx
	je	.LBB14_14
	incq	%rdx
	xorl	%esi, %esi
	andq	$-2, %rdx
	.p2align	4
.LBB14_16:
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5120(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	64(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5184(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	128(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5248(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	192(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5312(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	256(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5376(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	320(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5440(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	384(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5504(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	448(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5568(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	512(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5632(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	576(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5696(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	640(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5760(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	704(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5824(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	768(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5888(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	832(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 5952(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	vmovups	896(%rdi,%rsi,8), %zmm0
	vmovups	%zmm0, 6016(%r13,%rsi,8)
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%r15, %rdi
	addq	$-2, %rdx
	vmovupd	960(%rdi,%rsi,8), %zmm0
	vmovupd	%zmm0, 6080(%r13,%rsi,8)
	leaq	128(%rsi), %rsi
	jne	.LBB14_16
	testb	$8, %cl
	je	.LBB14_18
	testq	%rbp, %rbp
	jne	.LBB14_20
	jmp	.LBB14_22
.LBB14_14:
	xorl	%esi, %esi
.LBB14_18:
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 5120(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	64(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 5184(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	128(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 5248(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	192(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 5312(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	256(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 5376(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	320(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 5440(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovups	384(%rcx,%rsi,8), %zmm0
	vmovups	%zmm0, 5504(%r13,%rsi,8)
	movq	16(%r14), %rcx
	shlq	$8, %rcx
	addq	%r15, %rcx
	vmovupd	448(%rcx,%rsi,8), %zmm0
	vmovupd	%zmm0, 5568(%r13,%rsi,8)
	addq	$64, %rsi
	testq	%rbp, %rbp
	je	.LBB14_22
.LBB14_20:
	leaq	5120(%r13,%rsi,8), %rcx
	leaq	(%r15,%rsi,8), %rdx
	shll	$6, %ebp
	xorl	%esi, %esi
	.p2align	4
.LBB14_21:
	movq	16(%r14), %rdi
	shlq	$8, %rdi
	addq	%rdx, %rdi
	vmovupd	(%rsi,%rdi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %rbp
	jne	.LBB14_21
.LBB14_22:
	addq	$5376, %r13
	addq	$256, %r15
	addq	$5, %r12
	.p2align	4
.LBB14_23:
	movq	16(%r14), %rcx
	decq	%r12
	shlq	$8, %rcx
	vmovupd	(%r15,%rcx), %zmm0
	addq	$64, %r15
	vmovupd	%zmm0, (%r13)
	addq	$64, %r13
	cmpq	$5, %r12
	ja	.LBB14_23
	movq	16(%rsp), %r13
.LBB14_25:
	movl	%eax, (%r13)
	xorl	%eax, %eax
	addq	$24, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.Lfunc_end14:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v36B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2820_29x, .Lfunc_end14-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v36B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2820_29x
	.cfi_endproc

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI15_0:
	.quad	0x7fffffffffffffff
.LCPI15_1:
	.quad	0x3ff0000000000000
.LCPI15_2:
	.quad	0x3d06849b86a12b9b
.LCPI15_3:
	.quad	0x3fe0000000000000
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6probedB3v42B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6probedB3v42B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6probedB3v42B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEx:
	.cfi_startproc
	pushq	%rbp
	.cfi_def_cfa_offset 16
	pushq	%r15
	.cfi_def_cfa_offset 24
	pushq	%r14
	.cfi_def_cfa_offset 32
	pushq	%r13
	.cfi_def_cfa_offset 40
	pushq	%r12
	.cfi_def_cfa_offset 48
	pushq	%rbx
	.cfi_def_cfa_offset 56
	subq	$392, %rsp
	.cfi_def_cfa_offset 448
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	.cfi_offset %rbp, -16
	movq	624(%rsp), %r8
	movq	528(%rsp), %r12
	movq	456(%rsp), %r13
	movq	%rdx, %r9
	movq	%rdi, 112(%rsp)
	testq	%r8, %r8
	leaq	7(%r8), %rdx
	setle	%al
	movq	%rdx, %r10
	shrq	$3, %r10
	sete	%cl
	orb	%al, %cl
	je	.LBB15_1
	leaq	16(%rsp), %rbx
	leaq	8(%rsp), %rbp
	movq	$0, 16(%rsp)
	movq	$0, 8(%rsp)
	movq	%r13, %rdx
	movq	%r12, %rcx
	movq	%r8, %r15
	movq	%r9, %r14
	movq	%rbx, %rdi
	movq	%rbp, %rsi
	callq	*%r9
	movl	%eax, 40(%rsp)
	movq	$0, 16(%rsp)
	movq	$0, 8(%rsp)
	movq	%rbx, %rdi
	movq	%rbp, %rsi
	movq	%r13, %rdx
	movq	%r12, %rcx
	movq	%r15, %r8
	callq	*%r14
	leaq	8(%rsp), %rsi
	movl	%eax, %ebp
	movq	$0, 16(%rsp)
	movq	$0, 8(%rsp)
	movq	%rbx, %rdi
	movq	%r13, %rdx
	movq	%r12, %rcx
	movq	%r15, %r8
	callq	*%r14
	leaq	16(%rsp), %rdi
	leaq	8(%rsp), %rsi
	movl	%eax, %ebx
	movq	$0, 16(%rsp)
	movq	$0, 8(%rsp)
	movq	%r13, %rdx
	movq	%r12, %rcx
	movq	%r15, %r8
	callq	*%r14
	orl	40(%rsp), %ebp
	orl	%ebx, %eax
	orl	%ebp, %eax
	movslq	%eax, %rcx
	jmp	.LBB15_49
.LBB15_1:
	movq	584(%rsp), %rbp
	movl	%r10d, %eax
	andl	$7, %eax
	movq	%r9, 56(%rsp)
	movq	%rdx, 104(%rsp)
	movq	%rax, 72(%rsp)
	cmpq	$64, %rdx
	jae	.LBB15_6
	xorl	%r14d, %r14d
	jmp	.LBB15_3
.LBB15_6:
	leaq	-8(%r10), %rcx
	movq	%rcx, %rdx
	shrq	$3, %rdx
	movq	%rcx, 80(%rsp)
	leaq	1(%rdx), %rsi
	movl	%esi, %edi
	andl	$7, %edi
	cmpq	$56, %rcx
	jae	.LBB15_8
	xorl	%r14d, %r14d
	jmp	.LBB15_42
.LBB15_8:
	movq	%rsi, 64(%rsp)
	leaq	-7(%rdx), %rsi
	movabsq	$memset, %r15
	movq	%r10, 24(%rsp)
	movq	%rdx, 48(%rsp)
	movq	%rdi, 256(%rsp)
	movq	%rsi, %rbx
	shrq	$3, %rbx
	cmpq	$56, %rsi
	jae	.LBB15_10
	xorl	%r14d, %r14d
	jmp	.LBB15_39
.LBB15_10:
	leaq	-7(%rbx), %rax
	movq	%rsi, 128(%rsp)
	movq	%rbx, 192(%rsp)
	movq	%rax, %rsi
	shrq	$3, %rsi
	incq	%rsi
	movl	%esi, %ebx
	andl	$7, %ebx
	cmpq	$56, %rax
	jae	.LBB15_33
	xorl	%r14d, %r14d
	jmp	.LBB15_36
.LBB15_33:
	andq	$-8, %rsi
	movq	%rbx, 88(%rsp)
	xorl	%r14d, %r14d
	negq	%rsi
	.p2align	4
.LBB15_34:
	leaq	238080(%rbp), %rbx
	movl	$33024, %edx
	movq	%rsi, 40(%rsp)
	xorl	%esi, %esi
	leaq	(%rbx,%r14,8), %rax
	leaq	-229376(%rbx,%r14,8), %rdi
	movq	%rax, 32(%rsp)
	callq	*%r15
	leaq	-196608(%rbx,%r14,8), %rdi
	movl	$33024, %edx
	xorl	%esi, %esi
	callq	*%r15
	leaq	-163840(%rbx,%r14,8), %rdi
	movl	$33024, %edx
	xorl	%esi, %esi
	callq	*%r15
	leaq	-131072(%rbx,%r14,8), %rdi
	movl	$33024, %edx
	xorl	%esi, %esi
	callq	*%r15
	leaq	-98304(%rbx,%r14,8), %rdi
	movl	$33024, %edx
	xorl	%esi, %esi
	callq	*%r15
	leaq	-65536(%rbx,%r14,8), %rdi
	movl	$33024, %edx
	xorl	%esi, %esi
	callq	*%r15
	leaq	-32768(%rbx,%r14,8), %rdi
	movl	$33024, %edx
	xorl	%esi, %esi
	callq	*%r15
	movq	32(%rsp), %rdi
	movl	$33024, %edx
	xorl	%esi, %esi
	addq	$32768, %r14
	callq	*%r15
	movq	40(%rsp), %rsi
	addq	$8, %rsi
	jne	.LBB15_34
	movq	88(%rsp), %rbx
	testq	%rbx, %rbx
	je	.LBB15_38
.LBB15_36:
	negq	%rbx
	.p2align	4
.LBB15_37:
	leaq	8704(%rbp), %rax
	movl	$33024, %edx
	xorl	%esi, %esi
	leaq	(%rax,%r14,8), %rdi
	addq	$4096, %r14
	callq	*%r15
	incq	%rbx
	jne	.LBB15_37
.LBB15_38:
	movq	128(%rsp), %rax
	movq	192(%rsp), %rbx
	notl	%eax
	testb	$56, %al
	je	.LBB15_41
.LBB15_39:
	incl	%ebx
	andl	$7, %ebx
	negq	%rbx
	.p2align	4
.LBB15_40:
	leaq	8704(%rbp), %rdx
	xorl	%esi, %esi
	leaq	(%rdx,%r14,8), %rdi
	movl	$4352, %edx
	addq	$512, %r14
	callq	*%r15
	incq	%rbx
	jne	.LBB15_40
.LBB15_41:
	movq	256(%rsp), %rdi
	movq	56(%rsp), %r9
	movq	624(%rsp), %r8
	movq	24(%rsp), %r10
	movq	48(%rsp), %rdx
	movq	64(%rsp), %rsi
	testq	%rdi, %rdi
	je	.LBB15_44
.LBB15_42:
	leaq	8704(%rbp), %rax
	negq	%rdi
	vxorpd	%xmm0, %xmm0, %xmm0
	.p2align	4
.LBB15_43:
	vmovupd	%zmm0, 704(%rax,%r14,8)
	vmovupd	%zmm0, 640(%rax,%r14,8)
	vmovupd	%zmm0, 576(%rax,%r14,8)
	vmovupd	%zmm0, 512(%rax,%r14,8)
	vmovupd	%zmm0, 448(%rax,%r14,8)
	vmovupd	%zmm0, 384(%rax,%r14,8)
	vmovupd	%zmm0, 320(%rax,%r14,8)
	vmovupd	%zmm0, 256(%rax,%r14,8)
	vmovupd	%zmm0, 192(%rax,%r14,8)
	vmovupd	%zmm0, 128(%rax,%r14,8)
	vmovupd	%zmm0, 64(%rax,%r14,8)
	vmovupd	%zmm0, (%rax,%r14,8)
	addq	$64, %r14
	incq	%rdi
	jne	.LBB15_43
.LBB15_44:
	cmpq	$0, 72(%rsp)
	je	.LBB15_45
.LBB15_3:
	movq	72(%rsp), %rcx
	leaq	8960(%rbp,%r14,8), %rax
	vxorpd	%xmm0, %xmm0, %xmm0
	movl	%ecx, %r11d
	shll	$6, %r11d
	xorl	%ecx, %ecx
	.p2align	4
.LBB15_4:
	vmovupd	%zmm0, -256(%rax,%rcx)
	vmovupd	%zmm0, (%rax,%rcx)
	addq	$64, %rcx
	cmpq	%rcx, %r11
	jne	.LBB15_4
	leaq	-8(%r10), %rcx
	movq	%rcx, 80(%rsp)
	shrq	$3, %rcx
	movq	%rcx, 48(%rsp)
	leaq	1(%rcx), %rsi
.LBB15_46:
	movabsq	$.LCPI15_0, %rax
	leaq	4(%r10), %rdx
	addq	$5, %r10
	andq	$-2, %rsi
	xorl	%ecx, %ecx
	xorl	%r15d, %r15d
	movq	%r11, 32(%rsp)
	vbroadcastsd	(%rax), %zmm5
	movabsq	$.LCPI15_1, %rax
	movq	%rsi, 64(%rsp)
	movq	%r10, 24(%rsp)
	movq	%rdx, 40(%rsp)
	vbroadcastsd	(%rax), %zmm6
	movabsq	$.LCPI15_2, %rax
	vbroadcastsd	(%rax), %zmm7
	movabsq	$.LCPI15_3, %rax
	vbroadcastsd	(%rax), %zmm8
	xorl	%eax, %eax
	vmovupd	%zmm5, 256(%rsp)
	vmovupd	%zmm6, 192(%rsp)
	vmovupd	%zmm7, 128(%rsp)
	vmovupd	%zmm8, 320(%rsp)
	.p2align	4
.LBB15_47:
	movq	%r15, %rbx
	shlq	$8, %rbx
	movq	%rax, 120(%rsp)
	movq	%rcx, 88(%rsp)
	movq	%rdx, %rax
	xorl	%ecx, %ecx
	leaq	6656(%rbp,%rbx), %r14
	.p2align	4
.LBB15_15:
	vmovupd	-1024(%r14,%rcx), %zmm0
	movq	8(%r12), %rdx
	decq	%rax
	addq	%r15, %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vandpd	%zmm5, %zmm0, %zmm1
	vaddpd	%zmm6, %zmm1, %zmm1
	vmulpd	%zmm7, %zmm1, %zmm1
	vaddpd	(%r14,%rcx), %zmm1, %zmm1
	vaddpd	%zmm1, %zmm0, %zmm0
	vmovupd	%zmm0, (%rcx,%rdx)
	addq	$64, %rcx
	cmpq	$4, %rax
	jg	.LBB15_15
	leaq	16(%rsp), %rdi
	leaq	8(%rsp), %rsi
	movq	$0, 16(%rsp)
	movq	$0, 8(%rsp)
	movq	%r13, %rdx
	movq	%r12, %rcx
	vzeroupper
	callq	*%r9
	cmpq	$64, 104(%rsp)
	movl	%eax, 100(%rsp)
	jae	.LBB15_18
	vmovupd	256(%rsp), %zmm2
	vmovupd	192(%rsp), %zmm3
	vmovupd	128(%rsp), %zmm4
	movq	56(%rsp), %r9
	movq	624(%rsp), %r8
	movq	24(%rsp), %rdi
	movq	32(%rsp), %r10
	xorl	%ecx, %ecx
	jmp	.LBB15_25
	.p2align	4
.LBB15_18:
	vmovupd	256(%rsp), %zmm2
	vmovupd	192(%rsp), %zmm3
	vmovupd	128(%rsp), %zmm4
	cmpq	$0, 48(%rsp)
	movq	56(%rsp), %r9
	movq	624(%rsp), %r8
	movq	32(%rsp), %r10
	je	.LBB15_19
	movq	64(%rsp), %rax
	xorl	%ecx, %ecx
	.p2align	4
.LBB15_21:
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 7680(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	64(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 7744(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	128(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 7808(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	192(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 7872(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	256(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 7936(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	320(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8000(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	384(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8064(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	448(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8128(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	512(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8192(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	576(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8256(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	640(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8320(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	704(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8384(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	768(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8448(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	832(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8512(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovups	896(%rdx,%rcx,8), %zmm0
	vmovups	%zmm0, 8576(%rbp,%rcx,8)
	movq	16(%r12), %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	addq	$-2, %rax
	vmovupd	960(%rdx,%rcx,8), %zmm0
	vmovupd	%zmm0, 8640(%rbp,%rcx,8)
	leaq	128(%rcx), %rcx
	jne	.LBB15_21
	testb	$8, 80(%rsp)
	movq	24(%rsp), %rdi
	je	.LBB15_23
	cmpq	$0, 72(%rsp)
	jne	.LBB15_25
	jmp	.LBB15_27
.LBB15_19:
	movq	24(%rsp), %rdi
	xorl	%ecx, %ecx
.LBB15_23:
	movq	16(%r12), %rax
	shlq	$8, %rax
	addq	%r13, %rax
	vmovups	(%rax,%rcx,8), %zmm0
	vmovups	%zmm0, 7680(%rbp,%rcx,8)
	movq	16(%r12), %rax
	shlq	$8, %rax
	addq	%r13, %rax
	vmovups	64(%rax,%rcx,8), %zmm0
	vmovups	%zmm0, 7744(%rbp,%rcx,8)
	movq	16(%r12), %rax
	shlq	$8, %rax
	addq	%r13, %rax
	vmovups	128(%rax,%rcx,8), %zmm0
	vmovups	%zmm0, 7808(%rbp,%rcx,8)
	movq	16(%r12), %rax
	shlq	$8, %rax
	addq	%r13, %rax
	vmovups	192(%rax,%rcx,8), %zmm0
	vmovups	%zmm0, 7872(%rbp,%rcx,8)
	movq	16(%r12), %rax
	shlq	$8, %rax
	addq	%r13, %rax
	vmovups	256(%rax,%rcx,8), %zmm0
	vmovups	%zmm0, 7936(%rbp,%rcx,8)
	movq	16(%r12), %rax
	shlq	$8, %rax
	addq	%r13, %rax
	vmovups	320(%rax,%rcx,8), %zmm0
	vmovups	%zmm0, 8000(%rbp,%rcx,8)
	movq	16(%r12), %rax
	shlq	$8, %rax
	addq	%r13, %rax
	vmovups	384(%rax,%rcx,8), %zmm0
	vmovups	%zmm0, 8064(%rbp,%rcx,8)
	movq	16(%r12), %rax
	shlq	$8, %rax
	addq	%r13, %rax
	vmovupd	448(%rax,%rcx,8), %zmm0
	vmovupd	%zmm0, 8128(%rbp,%rcx,8)
	addq	$64, %rcx
	cmpq	$0, 72(%rsp)
	je	.LBB15_27
.LBB15_25:
	leaq	7680(%rbp), %rax
	xorl	%edx, %edx
	leaq	(%rax,%rcx,8), %rax
	leaq	(%r13,%rcx,8), %rcx
	.p2align	4
.LBB15_26:
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%rcx, %rsi
	vmovupd	(%rdx,%rsi), %zmm0
	vmovupd	%zmm0, (%rax,%rdx)
	addq	$64, %rdx
	cmpq	%rdx, %r10
	jne	.LBB15_26
.LBB15_27:
	movq	%rdi, %rax
	xorl	%ecx, %ecx
	.p2align	4
.LBB15_28:
	movq	16(%r12), %rdx
	decq	%rax
	shlq	$8, %rdx
	addq	%r13, %rdx
	vmovupd	256(%rcx,%rdx), %zmm0
	vmovupd	%zmm0, 7936(%rbp,%rcx)
	addq	$64, %rcx
	cmpq	$5, %rax
	jg	.LBB15_28
	movq	40(%rsp), %rax
	xorl	%ecx, %ecx
	.p2align	4
.LBB15_30:
	vmovupd	-1024(%r14,%rcx), %zmm0
	movq	8(%r12), %rdx
	decq	%rax
	addq	%r15, %rdx
	shlq	$8, %rdx
	addq	%r13, %rdx
	vandpd	%zmm2, %zmm0, %zmm1
	vaddpd	%zmm3, %zmm1, %zmm1
	vmulpd	%zmm4, %zmm1, %zmm1
	vaddpd	(%r14,%rcx), %zmm1, %zmm1
	vsubpd	%zmm1, %zmm0, %zmm0
	vmovupd	%zmm0, (%rcx,%rdx)
	addq	$64, %rcx
	cmpq	$4, %rax
	jg	.LBB15_30
	leaq	16(%rsp), %rdi
	leaq	8(%rsp), %rsi
	movq	$0, 16(%rsp)
	movq	$0, 8(%rsp)
	movq	%r13, %rdx
	movq	%r12, %rcx
	vzeroupper
	callq	*%r9
	cmpq	$64, 104(%rsp)
	jae	.LBB15_50
	vmovupd	256(%rsp), %zmm5
	vmovupd	192(%rsp), %zmm6
	vmovupd	128(%rsp), %zmm7
	vmovupd	320(%rsp), %zmm8
	movq	56(%rsp), %r9
	movq	24(%rsp), %r10
	movq	32(%rsp), %r11
	xorl	%edx, %edx
	jmp	.LBB15_57
	.p2align	4
.LBB15_50:
	vmovupd	256(%rsp), %zmm5
	vmovupd	192(%rsp), %zmm6
	vmovupd	128(%rsp), %zmm7
	vmovupd	320(%rsp), %zmm8
	cmpq	$0, 48(%rsp)
	movq	56(%rsp), %r9
	je	.LBB15_51
	movq	64(%rsp), %rcx
	xorl	%edx, %edx
	.p2align	4
.LBB15_53:
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8192(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	64(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8256(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	128(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8320(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	192(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8384(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	256(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8448(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	320(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8512(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	384(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8576(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	448(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8640(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	512(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8704(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	576(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8768(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	640(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8832(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	704(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8896(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	768(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 8960(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	832(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 9024(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	vmovups	896(%rsi,%rdx,8), %zmm0
	vmovups	%zmm0, 9088(%rbp,%rdx,8)
	movq	16(%r12), %rsi
	shlq	$8, %rsi
	addq	%r13, %rsi
	addq	$-2, %rcx
	vmovupd	960(%rsi,%rdx,8), %zmm0
	vmovupd	%zmm0, 9152(%rbp,%rdx,8)
	leaq	128(%rdx), %rdx
	jne	.LBB15_53
	testb	$8, 80(%rsp)
	movq	24(%rsp), %r10
	movq	32(%rsp), %r11
	je	.LBB15_55
	cmpq	$0, 72(%rsp)
	jne	.LBB15_57
	jmp	.LBB15_59
.LBB15_51:
	movq	24(%rsp), %r10
	movq	32(%rsp), %r11
	xorl	%edx, %edx
.LBB15_55:
	movq	16(%r12), %rcx
	shlq	$8, %rcx
	addq	%r13, %rcx
	vmovups	(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 8192(%rbp,%rdx,8)
	movq	16(%r12), %rcx
	shlq	$8, %rcx
	addq	%r13, %rcx
	vmovups	64(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 8256(%rbp,%rdx,8)
	movq	16(%r12), %rcx
	shlq	$8, %rcx
	addq	%r13, %rcx
	vmovups	128(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 8320(%rbp,%rdx,8)
	movq	16(%r12), %rcx
	shlq	$8, %rcx
	addq	%r13, %rcx
	vmovups	192(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 8384(%rbp,%rdx,8)
	movq	16(%r12), %rcx
	shlq	$8, %rcx
	addq	%r13, %rcx
	vmovups	256(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 8448(%rbp,%rdx,8)
	movq	16(%r12), %rcx
	shlq	$8, %rcx
	addq	%r13, %rcx
	vmovups	320(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 8512(%rbp,%rdx,8)
	movq	16(%r12), %rcx
	shlq	$8, %rcx
	addq	%r13, %rcx
	vmovups	384(%rcx,%rdx,8), %zmm0
	vmovups	%zmm0, 8576(%rbp,%rdx,8)
	movq	16(%r12), %rcx
	shlq	$8, %rcx
	addq	%r13, %rcx
	vmovupd	448(%rcx,%rdx,8), %zmm0
	vmovupd	%zmm0, 8640(%rbp,%rdx,8)
	addq	$64, %rdx
	cmpq	$0, 72(%rsp)
	je	.LBB15_59
.LBB15_57:
	leaq	8192(%rbp), %rcx
	xorl	%esi, %esi
	leaq	(%rcx,%rdx,8), %rcx
	leaq	(%r13,%rdx,8), %rdx
	.p2align	4
.LBB15_58:
	movq	16(%r12), %rdi
	shlq	$8, %rdi
	addq	%rdx, %rdi
	vmovupd	(%rsi,%rdi), %zmm0
	vmovupd	%zmm0, (%rcx,%rsi)
	addq	$64, %rsi
	cmpq	%rsi, %r11
	jne	.LBB15_58
.LBB15_59:
	leaq	256(%r13), %rdx
	leaq	8448(%rbp), %rsi
	movq	%r10, %rcx
	.p2align	4
.LBB15_60:
	movq	16(%r12), %rdi
	decq	%rcx
	shlq	$8, %rdi
	vmovupd	(%rdx,%rdi), %zmm0
	addq	$64, %rdx
	vmovupd	%zmm0, (%rsi)
	addq	$64, %rsi
	cmpq	$5, %rcx
	jg	.LBB15_60
	movq	40(%rsp), %rdx
	leaq	(%rbx,%rbx,2), %rcx
	leaq	8960(%rbp), %rdi
	movq	%r13, %rsi
	.p2align	4
.LBB15_62:
	vmovupd	-3328(%rdi,%rbx), %zmm0
	movq	8(%r12), %r8
	vmovupd	-8448(%rdi,%rcx), %zmm2
	decq	%rdx
	addq	%r15, %r8
	shlq	$8, %r8
	vandpd	%zmm5, %zmm0, %zmm1
	vaddpd	%zmm2, %zmm2, %zmm2
	vaddpd	%zmm6, %zmm1, %zmm1
	vmulpd	%zmm7, %zmm1, %zmm1
	vaddpd	-2304(%rdi,%rbx), %zmm1, %zmm1
	vmovupd	%zmm0, (%rsi,%r8)
	addq	$64, %rsi
	vmovupd	-1280(%rdi), %zmm0
	vmovupd	-768(%rdi), %zmm3
	vsubpd	%zmm3, %zmm0, %zmm4
	vaddpd	%zmm3, %zmm0, %zmm0
	vdivpd	%zmm1, %zmm8, %zmm1
	vmulpd	%zmm4, %zmm1, %zmm4
	vmulpd	%zmm1, %zmm2, %zmm2
	vmovupd	%zmm4, -7424(%rdi,%rbx)
	vmulpd	%zmm2, %zmm1, %zmm2
	vmovupd	-4864(%rdi), %zmm3
	vaddpd	%zmm3, %zmm3, %zmm3
	vsubpd	%zmm3, %zmm0, %zmm0
	vmulpd	%zmm0, %zmm2, %zmm0
	vaddpd	-256(%rdi), %zmm0, %zmm0
	vmovupd	%zmm0, -256(%rdi)
	vmovupd	-1024(%rdi), %zmm0
	vmovupd	-512(%rdi), %zmm3
	vsubpd	%zmm3, %zmm0, %zmm4
	vaddpd	%zmm3, %zmm0, %zmm0
	vmulpd	%zmm4, %zmm1, %zmm1
	vmovupd	%zmm1, -6912(%rdi,%rbx)
	vmovupd	-4608(%rdi), %zmm1
	vaddpd	%zmm1, %zmm1, %zmm1
	vsubpd	%zmm1, %zmm0, %zmm0
	vmulpd	%zmm0, %zmm2, %zmm0
	vaddpd	(%rdi), %zmm0, %zmm0
	vmovupd	%zmm0, (%rdi)
	addq	$64, %rdi
	cmpq	$4, %rdx
	jg	.LBB15_62
	orl	100(%rsp), %eax
	movq	88(%rsp), %rcx
	movq	624(%rsp), %r8
	movq	40(%rsp), %rdx
	movl	$1, %r15d
	cltq
	orq	%rax, %rcx
	testb	$1, 120(%rsp)
	movb	$1, %al
	je	.LBB15_47
	addq	$3328, %rbp
	.p2align	4
.LBB15_14:
	vmovupd	-1792(%rbp), %zmm0
	vmovupd	-1536(%rbp), %zmm1
	vmovupd	-1280(%rbp), %zmm2
	decq	%rdx
	vmulpd	%zmm0, %zmm0, %zmm3
	vmulpd	%zmm2, %zmm1, %zmm4
	vaddpd	%zmm4, %zmm3, %zmm3
	vmovupd	%zmm3, -768(%rbp)
	vmulpd	%zmm1, %zmm0, %zmm3
	vmulpd	%zmm2, %zmm0, %zmm0
	vmovupd	-1024(%rbp), %zmm5
	vmulpd	%zmm5, %zmm1, %zmm1
	vmulpd	%zmm5, %zmm2, %zmm2
	vaddpd	%zmm1, %zmm3, %zmm1
	vaddpd	%zmm2, %zmm0, %zmm0
	vmovupd	%zmm1, -512(%rbp)
	vmulpd	%zmm5, %zmm5, %zmm1
	vmovupd	%zmm0, -256(%rbp)
	vaddpd	%zmm1, %zmm4, %zmm0
	vmovupd	%zmm0, (%rbp)
	addq	$64, %rbp
	cmpq	$4, %rdx
	jg	.LBB15_14
.LBB15_49:
	movq	112(%rsp), %rax
	movq	%rcx, (%rax)
	xorl	%eax, %eax
	addq	$392, %rsp
	.cfi_def_cfa_offset 56
	popq	%rbx
	.cfi_def_cfa_offset 48
	popq	%r12
	.cfi_def_cfa_offset 40
	popq	%r13
	.cfi_def_cfa_offset 32
	popq	%r14
	.cfi_def_cfa_offset 24
	popq	%r15
	.cfi_def_cfa_offset 16
	popq	%rbp
	.cfi_def_cfa_offset 8
	vzeroupper
	retq
.LBB15_45:
	.cfi_def_cfa_offset 448
	xorl	%r11d, %r11d
	movq	%rdx, 48(%rsp)
	jmp	.LBB15_46
.Lfunc_end15:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6probedB3v42B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEx, .Lfunc_end15-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6probedB3v42B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEx
	.cfi_endproc

	.section	.rodata.cst8,"aM",@progbits,8
	.p2align	3, 0x0
.LCPI16_0:
	.quad	0x3ff0000000000000
	.section	.ltext,"axl",@progbits
	.weak	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5fadedB3v56B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxx
	.p2align	4
	.type	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5fadedB3v56B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxx,@function
_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5fadedB3v56B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxx:
	pushq	%rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	movq	192(%rsp), %rcx
	movq	%rdi, -72(%rsp)
	leaq	7(%rcx), %rdi
	movq	%rdi, %rax
	shrq	$3, %rax
	testq	%rcx, %rcx
	setle	%cl
	testq	%rax, %rax
	sete	%dl
	orb	%cl, %dl
	jne	.LBB16_29
	movq	168(%rsp), %rdx
	movq	184(%rsp), %r10
	movq	176(%rsp), %rcx
	movq	56(%rsp), %r9
	leaq	(%rdx,%rdx,4), %r8
	leaq	3(%r10), %rbx
	movq	%rbx, %rdx
	imulq	%rcx, %rdx
	shlq	$8, %r8
	addq	128(%rsp), %r8
	movq	%rdx, %rsi
	shlq	$8, %rsi
	movq	%r8, -88(%rsp)
	testq	%r10, %r10
	jle	.LBB16_5
	addq	%rcx, %rdx
	shlq	$8, %rcx
	movabsq	$9223372036854775800, %rdi
	shlq	$8, %rbx
	movl	%r10d, %r12d
	movq	%r10, %rbp
	shlq	$8, %rbp
	andl	$7, %r12d
	leaq	2560(%r9,%rsi), %r11
	leaq	(%r9,%rsi), %r14
	shlq	$8, %rdx
	leaq	768(%r9,%rcx), %r13
	leaq	-8(%r10), %rcx
	andq	%r10, %rdi
	movq	%rbx, -16(%rsp)
	movq	%r12, -96(%rsp)
	shll	$8, %r12d
	addq	$768, %rbp
	leaq	768(%rdx,%r9), %rdx
	movq	%rcx, -40(%rsp)
	shrq	$3, %rcx
	movq	%rdi, -80(%rsp)
	movabsq	$4611686018427387900, %rdi
	movq	%rcx, -24(%rsp)
	orq	$2, %rdi
	movq	%rdx, -8(%rsp)
	leaq	1(%rcx), %rdx
	movq	%rdx, %rcx
	andq	$-4, %rcx
	andq	%rdx, %rdi
	movl	%edx, %ebx
	andl	$3, %ebx
	movq	%rdx, -56(%rsp)
	movq	%rcx, -48(%rsp)
	movabsq	$.LCPI16_0, %rcx
	movq	%rdi, -32(%rsp)
	leaq	768(%r9,%rsi), %rdi
	movl	%ebx, %r9d
	shll	$11, %r9d
	movq	%rbx, -64(%rsp)
	xorl	%ebx, %ebx
	vbroadcastsd	(%rcx), %zmm0
	movq	$-2560, %rcx
	subq	%rsi, %rcx
	addq	$8704, %rsi
	jmp	.LBB16_3
	.p2align	4
.LBB16_25:
	movq	-88(%rsp), %r8
	vmulpd	%zmm1, %zmm1, %zmm1
	movq	-8(%rsp), %rdx
	addq	$64, %r11
	addq	$64, %rdi
	addq	$64, %r13
	addq	$-64, %rcx
	addq	$64, %rsi
	decq	%rax
	vsubpd	%zmm1, %zmm0, %zmm1
	vmulpd	256(%r8,%rbx,8), %zmm1, %zmm1
	vaddpd	(%rdx,%rbx,8), %zmm1, %zmm1
	vmovupd	%zmm1, (%rdx,%rbx,8)
	leaq	8(%rbx), %rbx
	jle	.LBB16_29
.LBB16_3:
	vmovupd	512(%r8,%rbx,8), %zmm1
	vmulpd	(%r14,%rbx,8), %zmm1, %zmm2
	vmovupd	%zmm2, (%r14,%rbx,8)
	vmulpd	256(%r14,%rbx,8), %zmm1, %zmm2
	vmovupd	%zmm2, 256(%r14,%rbx,8)
	vmulpd	512(%r14,%rbx,8), %zmm1, %zmm2
	vmovupd	%zmm2, 512(%r14,%rbx,8)
	cmpq	$8, %r10
	jae	.LBB16_7
	xorl	%edx, %edx
	jmp	.LBB16_14
	.p2align	4
.LBB16_7:
	movq	-48(%rsp), %r8
	movq	56(%rsp), %rdx
	cmpq	$24, -40(%rsp)
	movq	%r11, %r15
	jb	.LBB16_11
	.p2align	4
.LBB16_8:
	vmulpd	-7936(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -7936(%rdx,%rsi)
	vmulpd	-7680(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -7680(%rdx,%rsi)
	vmulpd	-7424(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -7424(%rdx,%rsi)
	vmulpd	-7168(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -7168(%rdx,%rsi)
	vmulpd	-6912(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -6912(%rdx,%rsi)
	vmulpd	-6656(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -6656(%rdx,%rsi)
	vmulpd	-6400(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -6400(%rdx,%rsi)
	vmulpd	-6144(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -6144(%rdx,%rsi)
	vmulpd	-5888(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -5888(%rdx,%rsi)
	vmulpd	-5632(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -5632(%rdx,%rsi)
	vmulpd	-5376(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -5376(%rdx,%rsi)
	vmulpd	-5120(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -5120(%rdx,%rsi)
	vmulpd	-4864(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -4864(%rdx,%rsi)
	vmulpd	-4608(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -4608(%rdx,%rsi)
	vmulpd	-4352(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -4352(%rdx,%rsi)
	vmulpd	-4096(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -4096(%rdx,%rsi)
	vmulpd	-3840(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -3840(%rdx,%rsi)
	vmulpd	-3584(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -3584(%rdx,%rsi)
	vmulpd	-3328(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -3328(%rdx,%rsi)
	vmulpd	-3072(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -3072(%rdx,%rsi)
	vmulpd	-2816(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -2816(%rdx,%rsi)
	vmulpd	-2560(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -2560(%rdx,%rsi)
	vmulpd	-2304(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -2304(%rdx,%rsi)
	vmulpd	-2048(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -2048(%rdx,%rsi)
	vmulpd	-1792(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -1792(%rdx,%rsi)
	vmulpd	-1536(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -1536(%rdx,%rsi)
	vmulpd	-1280(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -1280(%rdx,%rsi)
	vmulpd	-1024(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -1024(%rdx,%rsi)
	vmulpd	-768(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -768(%rdx,%rsi)
	vmulpd	-512(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -512(%rdx,%rsi)
	vmulpd	-256(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, -256(%rdx,%rsi)
	vmulpd	(%rdx,%rsi), %zmm1, %zmm2
	vmovupd	%zmm2, (%rdx,%rsi)
	addq	$8192, %rdx
	addq	$-4, %r8
	jne	.LBB16_8
	cmpq	$0, -64(%rsp)
	je	.LBB16_13
	subq	%rcx, %rdx
	movq	%rdx, %r15
.LBB16_11:
	xorl	%edx, %edx
	.p2align	4
.LBB16_12:
	vmulpd	-1792(%r15,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, -1792(%r15,%rdx)
	vmulpd	-1536(%r15,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, -1536(%r15,%rdx)
	vmulpd	-1280(%r15,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, -1280(%r15,%rdx)
	vmulpd	-1024(%r15,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, -1024(%r15,%rdx)
	vmulpd	-768(%r15,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, -768(%r15,%rdx)
	vmulpd	-512(%r15,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, -512(%r15,%rdx)
	vmulpd	-256(%r15,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, -256(%r15,%rdx)
	vmulpd	(%r15,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, (%r15,%rdx)
	addq	$2048, %rdx
	cmpq	%rdx, %r9
	jne	.LBB16_12
.LBB16_13:
	movq	-80(%rsp), %rdx
	cmpq	$0, -96(%rsp)
	je	.LBB16_18
.LBB16_14:
	shlq	$8, %rdx
	xorl	%r8d, %r8d
	addq	%rdi, %rdx
	.p2align	4
.LBB16_15:
	vmulpd	(%rdx,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rdx,%r8)
	addq	$256, %r8
	cmpq	%r8, %r12
	jne	.LBB16_15
	cmpq	$8, %r10
	jae	.LBB16_18
	xorl	%edx, %edx
	jmp	.LBB16_23
	.p2align	4
.LBB16_18:
	movq	-32(%rsp), %rdx
	cmpq	$0, -24(%rsp)
	movq	%r13, %r8
	je	.LBB16_21
	.p2align	4
.LBB16_19:
	vmulpd	(%r8), %zmm1, %zmm2
	leaq	(%r8,%rbp), %r15
	vmovupd	%zmm2, (%r8)
	vmulpd	(%r8,%rbp), %zmm1, %zmm2
	vmovupd	%zmm2, (%r8,%rbp)
	leaq	(%r15,%rbp), %r8
	vmulpd	(%rbp,%r15), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r15)
	leaq	(%r8,%rbp), %r15
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r8)
	leaq	(%r15,%rbp), %r8
	vmulpd	(%rbp,%r15), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r15)
	leaq	(%r8,%rbp), %r15
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r8)
	leaq	(%r15,%rbp), %r8
	vmulpd	(%rbp,%r15), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r15)
	leaq	(%r8,%rbp), %r15
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r8)
	leaq	(%r15,%rbp), %r8
	vmulpd	(%rbp,%r15), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r15)
	leaq	(%r8,%rbp), %r15
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r8)
	leaq	(%r15,%rbp), %r8
	vmulpd	(%rbp,%r15), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r15)
	leaq	(%r8,%rbp), %r15
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r8)
	leaq	(%r15,%rbp), %r8
	vmulpd	(%rbp,%r15), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r15)
	leaq	(%r8,%rbp), %r15
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	leaq	(%r15,%rbp), %r10
	vmovupd	%zmm2, (%rbp,%r8)
	leaq	(%rbp,%rbp), %r8
	vmulpd	(%rbp,%r15), %zmm1, %zmm2
	addq	%r10, %r8
	addq	$-2, %rdx
	vmovupd	%zmm2, (%rbp,%r15)
	vmulpd	(%rbp,%r10), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r10)
	jne	.LBB16_19
	testb	$1, -56(%rsp)
	je	.LBB16_22
.LBB16_21:
	vmulpd	(%r8), %zmm1, %zmm2
	leaq	(%r8,%rbp), %rdx
	vmovupd	%zmm2, (%r8)
	vmulpd	(%r8,%rbp), %zmm1, %zmm2
	vmovupd	%zmm2, (%r8,%rbp)
	leaq	(%rdx,%rbp), %r8
	vmulpd	(%rbp,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%rdx)
	leaq	(%r8,%rbp), %rdx
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r8)
	leaq	(%rdx,%rbp), %r8
	vmulpd	(%rbp,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%rdx)
	leaq	(%r8,%rbp), %rdx
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r8)
	leaq	(%rdx,%rbp), %r8
	vmulpd	(%rbp,%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%rdx)
	vmulpd	(%rbp,%r8), %zmm1, %zmm2
	vmovupd	%zmm2, (%rbp,%r8)
.LBB16_22:
	movq	-80(%rsp), %rdx
	cmpq	$0, -96(%rsp)
	movq	184(%rsp), %r10
	je	.LBB16_25
.LBB16_23:
	imulq	-16(%rsp), %rdx
	movq	-96(%rsp), %r8
	addq	%r13, %rdx
	.p2align	4
.LBB16_24:
	vmulpd	(%rdx), %zmm1, %zmm2
	vmovupd	%zmm2, (%rdx)
	addq	%rbp, %rdx
	decq	%r8
	jne	.LBB16_24
	jmp	.LBB16_25
.LBB16_5:
	andl	$3, %eax
	cmpq	$31, %rdi
	ja	.LBB16_30
	addq	$4, %r10
	movq	%r9, %rbx
	imulq	%r10, %rcx
	xorl	%r10d, %r10d
	shlq	$8, %rcx
	jmp	.LBB16_27
.LBB16_30:
	movabsq	$.LCPI16_0, %r11
	addq	$4, %r10
	shrq	$5, %rdi
	leaq	704(%r8), %rdx
	leaq	704(%r9,%rsi), %r8
	movq	%r9, %rbx
	vbroadcastsd	(%r11), %zmm0
	imulq	%r10, %rcx
	shlq	$2, %rdi
	xorl	%r10d, %r10d
	shlq	$8, %rcx
	leaq	960(%r9,%rcx), %r9
	.p2align	4
.LBB16_31:
	vmovupd	-192(%rdx,%r10,8), %zmm1
	addq	$-4, %rdi
	vmulpd	-704(%r8,%r10,8), %zmm1, %zmm2
	vmovupd	%zmm2, -704(%r8,%r10,8)
	vmulpd	-448(%r8,%r10,8), %zmm1, %zmm2
	vmovupd	%zmm2, -448(%r8,%r10,8)
	vmulpd	-192(%r8,%r10,8), %zmm1, %zmm2
	vmulpd	%zmm1, %zmm1, %zmm1
	vsubpd	%zmm1, %zmm0, %zmm1
	vmovupd	%zmm2, -192(%r8,%r10,8)
	vmulpd	-448(%rdx,%r10,8), %zmm1, %zmm1
	vaddpd	-192(%r9,%r10,8), %zmm1, %zmm1
	vmovupd	%zmm1, -192(%r9,%r10,8)
	vmovupd	-128(%rdx,%r10,8), %zmm1
	vmulpd	-640(%r8,%r10,8), %zmm1, %zmm2
	vmovupd	%zmm2, -640(%r8,%r10,8)
	vmulpd	-384(%r8,%r10,8), %zmm1, %zmm2
	vmovupd	%zmm2, -384(%r8,%r10,8)
	vmulpd	-128(%r8,%r10,8), %zmm1, %zmm2
	vmulpd	%zmm1, %zmm1, %zmm1
	vsubpd	%zmm1, %zmm0, %zmm1
	vmovupd	%zmm2, -128(%r8,%r10,8)
	vmulpd	-384(%rdx,%r10,8), %zmm1, %zmm1
	vaddpd	-128(%r9,%r10,8), %zmm1, %zmm1
	vmovupd	%zmm1, -128(%r9,%r10,8)
	vmovupd	-64(%rdx,%r10,8), %zmm1
	vmulpd	-576(%r8,%r10,8), %zmm1, %zmm2
	vmovupd	%zmm2, -576(%r8,%r10,8)
	vmulpd	-320(%r8,%r10,8), %zmm1, %zmm2
	vmovupd	%zmm2, -320(%r8,%r10,8)
	vmulpd	-64(%r8,%r10,8), %zmm1, %zmm2
	vmulpd	%zmm1, %zmm1, %zmm1
	vsubpd	%zmm1, %zmm0, %zmm1
	vmovupd	%zmm2, -64(%r8,%r10,8)
	vmulpd	-320(%rdx,%r10,8), %zmm1, %zmm1
	vaddpd	-64(%r9,%r10,8), %zmm1, %zmm1
	vmovupd	%zmm1, -64(%r9,%r10,8)
	vmovupd	(%rdx,%r10,8), %zmm1
	vmulpd	-512(%r8,%r10,8), %zmm1, %zmm2
	vmovupd	%zmm2, -512(%r8,%r10,8)
	vmulpd	-256(%r8,%r10,8), %zmm1, %zmm2
	vmovupd	%zmm2, -256(%r8,%r10,8)
	vmulpd	(%r8,%r10,8), %zmm1, %zmm2
	vmulpd	%zmm1, %zmm1, %zmm1
	vsubpd	%zmm1, %zmm0, %zmm1
	vmovupd	%zmm2, (%r8,%r10,8)
	vmulpd	-256(%rdx,%r10,8), %zmm1, %zmm1
	vaddpd	(%r9,%r10,8), %zmm1, %zmm1
	vmovupd	%zmm1, (%r9,%r10,8)
	leaq	32(%r10), %r10
	jne	.LBB16_31
	movq	-88(%rsp), %r8
	testq	%rax, %rax
	je	.LBB16_29
.LBB16_27:
	movabsq	$.LCPI16_0, %r9
	addq	%rbx, %rcx
	addq	%rbx, %rsi
	leaq	512(%r8,%r10,8), %rdx
	shll	$6, %eax
	xorl	%edi, %edi
	vbroadcastsd	(%r9), %zmm0
	leaq	768(%rcx,%r10,8), %rcx
	leaq	512(%rsi,%r10,8), %rsi
	.p2align	4
.LBB16_28:
	vmovupd	(%rdx,%rdi), %zmm1
	vmulpd	-512(%rsi,%rdi), %zmm1, %zmm2
	vmovupd	%zmm2, -512(%rsi,%rdi)
	vmulpd	-256(%rsi,%rdi), %zmm1, %zmm2
	vmovupd	%zmm2, -256(%rsi,%rdi)
	vmulpd	(%rsi,%rdi), %zmm1, %zmm2
	vmulpd	%zmm1, %zmm1, %zmm1
	vsubpd	%zmm1, %zmm0, %zmm1
	vmovupd	%zmm2, (%rsi,%rdi)
	vmulpd	-256(%rdx,%rdi), %zmm1, %zmm1
	vaddpd	(%rcx,%rdi), %zmm1, %zmm1
	vmovupd	%zmm1, (%rcx,%rdi)
	addq	$64, %rdi
	cmpq	%rdi, %rax
	jne	.LBB16_28
.LBB16_29:
	movq	-72(%rsp), %rax
	movq	$0, (%rax)
	xorl	%eax, %eax
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.Lfunc_end16:
	.size	_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5fadedB3v56B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxx, .Lfunc_end16-_ZN42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5fadedB3v56B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxx

	.type	.const.track,@object
	.section	.lrodata,"al",@progbits
.const.track:
	.asciz	"track"
	.size	.const.track, 6

	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx,8,8
	.type	".const.missing Environment: _ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx",@object
	.p2align	4, 0x0
".const.missing Environment: _ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx":
	.asciz	"missing Environment: _ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx"
	.size	".const.missing Environment: _ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5trackB3v16B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEdx5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5TupleI5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedEEx", 779

	.type	".const.can't unbox array from PyObject into native value.  The object maybe of a different type",@object
	.p2align	4, 0x0
".const.can't unbox array from PyObject into native value.  The object maybe of a different type":
	.asciz	"can't unbox array from PyObject into native value.  The object maybe of a different type"
	.size	".const.can't unbox array from PyObject into native value.  The object maybe of a different type", 89

	.type	".const.size mismatch for tuple, expected 5 element(s) but got %zd",@object
	.p2align	4, 0x0
".const.size mismatch for tuple, expected 5 element(s) but got %zd":
	.asciz	"size mismatch for tuple, expected 5 element(s) but got %zd"
	.size	".const.size mismatch for tuple, expected 5 element(s) but got %zd", 59

	.type	".const.Error creating Python tuple from runtime exception arguments",@object
	.p2align	4, 0x0
".const.Error creating Python tuple from runtime exception arguments":
	.asciz	"Error creating Python tuple from runtime exception arguments"
	.size	".const.Error creating Python tuple from runtime exception arguments", 61

	.type	".const.unknown error when calling native function",@object
	.p2align	4, 0x0
".const.unknown error when calling native function":
	.asciz	"unknown error when calling native function"
	.size	".const.unknown error when calling native function", 43

	.type	".const.Error creating Python tuple from runtime exception arguments.1",@object
	.p2align	4, 0x0
".const.Error creating Python tuple from runtime exception arguments.1":
	.asciz	"Error creating Python tuple from runtime exception arguments"
	.size	".const.Error creating Python tuple from runtime exception arguments.1", 61

	.type	".const.unknown error when calling native function.2",@object
	.p2align	4, 0x0
".const.unknown error when calling native function.2":
	.asciz	"unknown error when calling native function"
	.size	".const.unknown error when calling native function.2", 43

	.type	".const.<numba.core.cpu.CPUContext>",@object
	.p2align	4, 0x0
".const.<numba.core.cpu.CPUContext>":
	.asciz	"<numba.core.cpu.CPUContext>"
	.size	".const.<numba.core.cpu.CPUContext>", 28

	.type	_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB3v17B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWsFpNAA_3d_3dEx,@object
	.comm	_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB3v17B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWsFpNAA_3d_3dEx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10linearisedB3v21B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10linearisedB3v21B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dExx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9correctedB3v52B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdxx5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedExx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9correctedB3v52B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdxx5ArrayIdLi3E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedExx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7crossedB3v53B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxddxxbx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7crossedB3v53B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxddxxbx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5shownB3v23B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5shownB3v23B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v26B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v26B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f8reachingB3v22B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedEx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f8reachingB3v22B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedEx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v27B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_2924Literal_5bint_5d_2828_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v27B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE23Literal_5bint_5d_280_2924Literal_5bint_5d_2828_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6wantedB3v46B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6wantedB3v46B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6widestB3v47B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6widestB3v47B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExx,8,8
	.type	_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v18B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWsFpNAA_3d_3dE15StarArgUniTupleIxLi2EE,@object
	.comm	_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v18B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWsFpNAA_3d_3dE15StarArgUniTupleIxLi2EE,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9attemptedB3v48B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxddx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f9attemptedB3v48B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxddx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6drivenB3v20B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi3E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExdx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v32B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29d24Literal_5bint_5d_2822_2924Literal_5bint_5d_2816_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v32B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2814_29d24Literal_5bint_5d_2822_2924Literal_5bint_5d_2816_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v33B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v33B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v34B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2818_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v34B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2816_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2818_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v35B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v35B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v36B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2820_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6stagedB3v36B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2818_29d24Literal_5bint_5d_2824_2924Literal_5bint_5d_2820_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v37B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2820_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v37B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2820_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v38B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2824_2924Literal_5bint_5d_2838_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f10both_sidesB3v38B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2824_2924Literal_5bint_5d_2838_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7hopefulB3v49B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7hopefulB3v49B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedExxdx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5shownB3v40B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2822_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5shownB3v40B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2822_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v28B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2830_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v28B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2830_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v41B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2832_29x,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v41B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedE24Literal_5bint_5d_2832_29x,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6probedB3v42B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f6probedB3v42B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedEx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v43B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7derivedB3v43B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dEx5ArrayIdLi2E1C7mutable7alignedE5ArrayIxLi1E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f8straightB3v44B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedEdx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f8straightB3v44B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedEdx,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7carriedB3v55B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxdxxbx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f7carriedB3v55B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxdxxbx,8,8
	.type	_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB3v19B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWsFpNAA_3d_3dEd,@object
	.comm	_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB3v19B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWsFpNAA_3d_3dEd,8,8
	.type	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5fadedB3v56B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxx,@object
	.comm	_ZN08NumbaEnv42lostmotion_kernel_8e3c251f9d39dd65ecdeb13f5fadedB3v56B52c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWqCQhqcRsCJNAA_3d_3dE5ArrayIdLi2E1C7mutable7alignedE5ArrayIdLi2E1C7mutable7alignedExxxx,8,8
	.section	".note.GNU-stack","",@progbits
