"""What is warm, and where: from 64 temperatures and a scan to sources on walls."""
